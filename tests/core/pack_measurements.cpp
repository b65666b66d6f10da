// Compiled once per instruction set. Nothing of the standard library that is not a plain function is called here, since
// what this file instantiates runs instructions that the processor may not have.

#include "tests/core/pack_measurements.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>

#include "core/pack.hpp"
#include "core/random.hpp"
#include "core/symmetric_eigen.hpp"
#include "tests/core/hard_roundings.hpp"

namespace ridgeloc::tests {

namespace {

using core::NativeReal;
constexpr std::size_t lanes = core::lanes<NativeReal>;
constexpr int rounds = 20'000;

/// A number sequence for test values.
class Sequence {
 public:
  std::uint64_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return state_;
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Positive, its exponent uniform between two bounds.
  double spread(double low, double high) { return std::exp2(low + (high - low) * uniform()); }

 private:
  std::uint64_t state_ = 0x9E3779B97F4A7C15U;
};

double ulp_of(long double exact) {
  const double rounded = std::fabs(static_cast<double>(exact));
  return std::nextafter(rounded, INFINITY) - rounded;
}

void raise(double& worst, double value) {
  if (!(value <= worst)) worst = value;
}

bool same(double a, double b) {
  return core::bits_of(a) == core::bits_of(b) || (a != a && b != b);
}

/// Roots and reciprocals of one number per lane.
void check_roots(const double (&x)[lanes], PackMeasurements& m) {
  double root[lanes], inverse[lanes], reciprocal[lanes], plain[lanes];
  const auto values = core::load<NativeReal>(x);
  const auto both = core::root_and_inverse(values);
  core::store(root, both.root);
  core::store(inverse, both.inverse);
  core::store(reciprocal, core::reciprocal(values));
  core::store(plain, core::sqrt(values));
  for (std::size_t l = 0; l < lanes; ++l) {
    m.wrong_roots += same(root[l], std::sqrt(x[l])) && same(plain[l], root[l]) ? 0 : 1;
    m.wrong_root_inverses += same(inverse[l], 1.0 / std::sqrt(x[l])) ? 0 : 1;
    m.wrong_reciprocals += same(reciprocal[l], 1.0 / x[l]) ? 0 : 1;
  }
}

void check_reciprocals(const double (&x)[lanes], PackMeasurements& m) {
  double got[lanes];
  core::store(got, core::reciprocal(core::load<NativeReal>(x)));
  for (std::size_t l = 0; l < lanes; ++l) m.wrong_reciprocals += same(got[l], 1.0 / x[l]) ? 0 : 1;
}

/// The number of `steps` neighbours from x on.
double neighbour(double x, std::int64_t steps) {
  return core::from_bits(core::bits_of(x) + static_cast<std::uint64_t>(steps));
}

/// Calls f with numbers whose reciprocals, roots or reciprocals of roots are hard to round: those of
/// hard_roundings.hpp, and numbers whose roots are, give or take a neighbour.
template <class F>
void for_each_hard(F f) {
  for (const std::uint64_t fraction : hard_reciprocals) {
    const double x = static_cast<double>(fraction) * 0x1p-52;
    f(x);
    for (std::int64_t steps = -2; steps <= 2; ++steps) f(neighbour(x * x, steps));
  }
  for (const std::uint64_t fraction : hard_roots) f(static_cast<double>(fraction) * 0x1p-52);
}

void measure_roots(Sequence& sequence, PackMeasurements& m) {
  double x[lanes];
  for (int i = 0; i < rounds; ++i) {
    for (double& value : x) value = sequence.spread(-900.0, 900.0);
    check_roots(x, m);
  }
  for_each_hard([&](double hard) {
    // Every lane another power of four, which leaves the fraction of the root as it is.
    for (std::size_t l = 0; l < lanes; ++l) x[l] = std::ldexp(hard, 2 * static_cast<int>(l) - 14);
    check_roots(x, m);
  });
  // The ends of all fractions of every exponent, of either sign where it has a meaning.
  constexpr std::int64_t ends = 32;
  for (int exponent = -1000; exponent < 1000; ++exponent) {
    for (std::int64_t first = -ends; first < ends; first += static_cast<std::int64_t>(lanes)) {
      for (std::size_t l = 0; l < lanes; ++l) {
        x[l] = neighbour(std::ldexp(1.0, exponent), first + static_cast<std::int64_t>(l));
      }
      if (exponent > -960) check_roots(x, m);
      check_reciprocals(x, m);
      for (double& value : x) value = -value;
      check_reciprocals(x, m);
    }
  }
  for (const double special : {0.0, -0.0, double(INFINITY), -double(INFINITY), -2.0, double(NAN)}) {
    const std::size_t before = m.wrong_roots + m.wrong_root_inverses + m.wrong_reciprocals;
    for (std::size_t l = 0; l < lanes; ++l) x[l] = l % 2 == 0 ? special : 1.0;
    check_roots(x, m);
    m.wrong_specials += m.wrong_roots + m.wrong_root_inverses + m.wrong_reciprocals - before;
  }
}

/// A seed within 2^-14 of a value, of 27 significant bits.
double seed_of(double value, Sequence& sequence) {
  const double rough = value * (1.0 + (sequence.uniform() - 0.5) * 0x1.fffp-14);
  const double shift = rough * (0x1p26 + 1.0);
  return shift - (shift - rough);
}

/// Refined values from seeds that other processors might have.
void check_seeds(const double (&x)[lanes], Sequence& sequence, PackMeasurements& m) {
  double seed[lanes], got[lanes];
  for (std::size_t l = 0; l < lanes; ++l) seed[l] = seed_of(1.0 / x[l], sequence);
  core::store(got, core::refine_reciprocal(core::load<NativeReal>(x), core::load<NativeReal>(seed)));
  for (std::size_t l = 0; l < lanes; ++l) m.seed_dependent += got[l] == 1.0 / x[l] ? 0 : 1;

  for (std::size_t l = 0; l < lanes; ++l) seed[l] = seed_of(1.0 / std::sqrt(x[l]), sequence);
  const auto both = core::refine_root_and_inverse(core::load<NativeReal>(x), core::load<NativeReal>(seed));
  core::store(got, both.root);
  for (std::size_t l = 0; l < lanes; ++l) m.seed_dependent += got[l] == std::sqrt(x[l]) ? 0 : 1;
  core::store(got, both.inverse);
  for (std::size_t l = 0; l < lanes; ++l) m.seed_dependent += got[l] == 1.0 / std::sqrt(x[l]) ? 0 : 1;
}

/// Refining needs fused multiply-adds; elsewhere it is not used.
void measure_seeds(Sequence& sequence, PackMeasurements& m) {
  if (core::native_isa == core::Isa::Baseline) return;
  double x[lanes];
  for (int i = 0; i < rounds; ++i) {
    // Half of them just below 2, where the last rounding is hardest to get right.
    for (double& value : x) {
      value = i % 2 == 0 ? sequence.spread(-300.0, 300.0)
                         : 2.0 - static_cast<double>(1 + sequence.next() % 10'000) * 0x1p-52;
    }
    check_seeds(x, sequence, m);
  }
  for_each_hard([&](double hard) {
    for (double& value : x) value = hard;
    for (int i = 0; i < 200; ++i) check_seeds(x, sequence, m);
  });
}

void measure_products(Sequence& sequence, PackMeasurements& m) {
  double a[lanes], b[lanes], c[lanes], sum[lanes], difference[lanes];
  constexpr bool fused = core::native_isa != core::Isa::Baseline;
  for (int i = 0; i < 1000; ++i) {
    for (std::size_t l = 0; l < lanes; ++l) {
      a[l] = sequence.uniform() - 0.5;
      b[l] = sequence.uniform() - 0.5;
      c[l] = sequence.uniform() - 0.5;
    }
    const auto load = [](const double* from) { return core::load<NativeReal>(from); };
    core::store(sum, core::mul_add(load(a), load(b), load(c)));
    core::store(difference, core::neg_mul_add(load(a), load(b), load(c)));
    for (std::size_t l = 0; l < lanes; ++l) {
      m.wrong_products += sum[l] == (fused ? std::fma(a[l], b[l], c[l]) : a[l] * b[l] + c[l]) ? 0 : 1;
      m.wrong_products += difference[l] == (fused ? std::fma(-a[l], b[l], c[l]) : c[l] - a[l] * b[l]) ? 0 : 1;
    }
  }
}

void measure_words(Sequence& sequence, PackMeasurements& m) {
  using Words = core::Words<NativeReal>;
  const core::Stream stream(2018, "scene");
  const auto key = static_cast<std::uint32_t>(stream.key());
  const auto key_high = static_cast<std::uint32_t>(stream.key() >> 32);
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t first = sequence.next() >> (i % 3 == 0 ? 1 : 33);
    const std::uint64_t draw = sequence.next() >> 40;
    const auto block = stream.block(core::trial_words<NativeReal>(first), Words(draw));
    for (std::size_t word = 0; word < 4; ++word) {
      double bits[lanes];
      core::store(bits, core::from_bits(block[word]));
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::uint64_t trial = first + l;
        const auto expected = philox4x32_R(10,
                                           {{static_cast<std::uint32_t>(trial), static_cast<std::uint32_t>(trial >> 32),
                                             static_cast<std::uint32_t>(draw), static_cast<std::uint32_t>(draw >> 32)}},
                                           {{key, key_high}});
        m.wrong_words += static_cast<std::uint32_t>(core::bits_of(bits[l])) == expected.v[word] ? 0 : 1;
      }
    }
  }
}

void measure_functions(Sequence& sequence, PackMeasurements& m) {
  const long double two_pi = 2.0L * std::acos(-1.0L);
  double x[lanes], turns[lanes], got[lanes];
  for (int i = 0; i < rounds; ++i) {
    for (double& value : x) value = i % 2 == 0 ? sequence.spread(-1000.0, 1000.0) : sequence.spread(-1.0, 1.0);
    core::store(got, core::log(core::load<NativeReal>(x)));
    for (std::size_t l = 0; l < lanes; ++l) {
      const long double exact = std::log(static_cast<long double>(x[l]));
      raise(m.log_error_ulp, static_cast<double>(std::fabs(got[l] - exact)) / ulp_of(exact));
    }
    core::store(got, core::inverse_cube_root(core::load<NativeReal>(x)));
    for (std::size_t l = 0; l < lanes; ++l) {
      const long double exact = 1.0L / std::cbrt(static_cast<long double>(x[l]));
      raise(m.inverse_cube_root_error_ulp, static_cast<double>(std::fabs(got[l] - exact)) / ulp_of(exact));
    }
    for (double& value : x) {
      value = i % 2 == 0 ? 1416.0 * sequence.uniform() - 708.0 : sequence.spread(-60.0, 1.0);
      if (i % 4 == 3) value = -value;
    }
    core::store(got, core::exp(core::load<NativeReal>(x)));
    for (std::size_t l = 0; l < lanes; ++l) {
      const long double exact = std::exp(static_cast<long double>(x[l]));
      raise(m.exp_error_ulp, static_cast<double>(std::fabs(got[l] - exact)) / ulp_of(exact));
    }
    core::store(got, core::exp_minus_one(core::load<NativeReal>(x)));
    for (std::size_t l = 0; l < lanes; ++l) {
      const long double exact = std::expm1(static_cast<long double>(x[l]));
      raise(m.exp_minus_one_error_ulp, static_cast<double>(std::fabs(got[l] - exact)) / ulp_of(exact));
    }
    for (double& value : turns) value = 3.0 * sequence.uniform() - 1.5;
    const auto both = core::sin_cos_turns(core::load<NativeReal>(turns));
    core::store(got, both.sin);
    double cosine[lanes];
    core::store(cosine, both.cos);
    for (std::size_t l = 0; l < lanes; ++l) {
      const long double rest = static_cast<long double>(turns[l]) - std::nearbyint(static_cast<long double>(turns[l]));
      raise(m.sin_cos_error, static_cast<double>(std::fabs(got[l] - std::sin(two_pi * rest))) * 0x1p53);
      raise(m.sin_cos_error, static_cast<double>(std::fabs(cosine[l] - std::cos(two_pi * rest))) * 0x1p53);
    }
  }
}

/// Columns of every length around the number of lanes, between numbers that must not be touched.
void measure_columns(PackMeasurements& m) {
  for (std::size_t size = 1; size <= 2 * lanes + 1; ++size) {
    double column[2 * lanes + 4];
    for (std::size_t i = 0; i < 2 * lanes + 4; ++i) column[i] = i < size ? static_cast<double>(i) : -7.0;
    for (std::size_t first = 0; first < size; first += lanes) {
      const auto loaded = core::load_column<NativeReal>(std::span<const double>(column, size), first);
      core::store_column(std::span<double>(column, size), first, loaded + NativeReal(100.0));
    }
    for (std::size_t i = 0; i < 2 * lanes + 4; ++i) {
      m.wrong_columns += column[i] == (i < size ? static_cast<double>(i) + 100.0 : -7.0) ? 0 : 1;
    }
  }
}

void measure_masks(PackMeasurements& m) {
  double x[lanes], got[lanes];
  const auto numbers = core::lane_numbers<NativeReal>(0);
  for (std::size_t bits = 0; bits < (std::size_t{1} << lanes); ++bits) {
    for (std::size_t l = 0; l < lanes; ++l) x[l] = (bits >> l & 1U) != 0 ? 1.0 : (l % 2 == 0 ? -1.0 : double(NAN));
    const auto mask = core::load<NativeReal>(x) > NativeReal(0.0);
    m.wrong_masks += core::lane_bits(mask) == bits && core::any(mask) == (bits != 0) ? 0 : 1;
    m.wrong_masks += core::lane_bits(!mask) == (~bits & ((std::size_t{1} << lanes) - 1)) ? 0 : 1;
    core::store(got, core::select(mask, numbers, NativeReal(-5.0)));
    for (std::size_t l = 0; l < lanes; ++l) {
      m.wrong_masks += got[l] == ((bits >> l & 1U) != 0 ? static_cast<double>(l) : -5.0) ? 0 : 1;
    }
  }
}

/// Lanes that need no, few and many rotations side by side, and each of them in all lanes.
template <std::size_t P>
void measure_eigens(Sequence& sequence, PackMeasurements& m) {
  using Matrix = core::Symmetric<NativeReal, P>;
  for (int i = 0; i < rounds / 100; ++i) {
    double x[Matrix::size][lanes];
    for (auto& element : x) {
      for (std::size_t l = 0; l < lanes; ++l)
        element[l] = l % 3 == 0 ? 0.0 : sequence.spread(-30.0, l % 3 == 1 ? -20.0 : 0.0);
    }
    for (std::size_t d = 0; d < P; ++d) {
      for (std::size_t l = 0; l < lanes; ++l) x[Matrix::index(d, d)][l] = sequence.spread(-1.0, 1.0);
    }
    Matrix together;
    for (std::size_t e = 0; e < Matrix::size; ++e) together.upper[e] = core::load<NativeReal>(x[e]);
    const auto all = core::symmetric_eigen(together);
    for (std::size_t l = 0; l < lanes; ++l) {
      Matrix alone;
      for (std::size_t e = 0; e < Matrix::size; ++e) alone.upper[e] = NativeReal(x[e][l]);
      const auto one = core::symmetric_eigen(alone);
      double a[lanes], b[lanes];
      for (std::size_t d = 0; d < P; ++d) {
        core::store(a, all.values[d]);
        core::store(b, one.values[d]);
        m.dependent_eigens += same(a[l], b[l]) ? 0 : 1;
        for (std::size_t k = 0; k < P; ++k) {
          core::store(a, all.vectors[d][k]);
          core::store(b, one.vectors[d][k]);
          m.dependent_eigens += same(a[l], b[l]) ? 0 : 1;
        }
      }
    }
  }
}

}  // namespace

template <>
PackMeasurements measure_packs<core::native_isa>() {
  PackMeasurements m;
  m.lanes = lanes;
  Sequence sequence;
  measure_roots(sequence, m);
  measure_seeds(sequence, m);
  measure_products(sequence, m);
  measure_words(sequence, m);
  measure_functions(sequence, m);
  measure_columns(m);
  measure_masks(m);
  measure_eigens<2>(sequence, m);
  measure_eigens<3>(sequence, m);
  measure_eigens<4>(sequence, m);
  return m;
}

}  // namespace ridgeloc::tests
