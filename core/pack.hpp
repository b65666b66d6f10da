#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "core/isa.hpp"
#include "core/native.hpp"
#include "core/real.hpp"
#include "core/refine.hpp"

/// SIMD packs: the vocabulary of core/real.hpp for several trials at once. The type of a pack names the instruction set
/// of the source file that includes this, so that kernels for several live in one program.
namespace ridgeloc::core {

/// The instruction set that this source file is compiled for.
#if defined(__AVX512F__)
static constexpr Isa native_isa = Isa::Avx512;
#elif defined(__AVX2__)
static constexpr Isa native_isa = Isa::Avx2;
#else
static constexpr Isa native_isa = Isa::Baseline;
#endif

/// Several registers. A step of an iteration is one long chain of dependent operations: with two registers for each
/// value, the processor has a second, independent chain to work on while the first waits.
template <class Batch, std::size_t Count>
struct Pack {
  std::array<Batch, Count> r;

  Pack() = default;
  [[gnu::always_inline]] explicit Pack(const std::array<Batch, Count>& registers) : r(registers) {}
  template <class Scalar>
  requires std::is_arithmetic_v<Scalar>
  [[gnu::always_inline]] explicit Pack(Scalar x) : Pack(x, std::make_index_sequence<Count>{}) {}

 private:
  template <class Scalar, std::size_t... I>
  [[gnu::always_inline]] Pack(Scalar x, std::index_sequence<I...>)
      : r{((void)I, Batch(static_cast<typename Batch::value_type>(x)))...} {}
};

/// Calls f with 0, 1, ..., Count - 1 as constants and makes a pack of the results. Never a loop: the compiler would
/// keep what a loop indexes in memory.
template <std::size_t Count, class F>
[[gnu::always_inline]] inline auto make_pack(F f) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    using Batch = decltype(f(std::integral_constant<std::size_t, 0>{}));
    return Pack<Batch, Count>(std::array<Batch, Count>{f(std::integral_constant<std::size_t, I>{})...});
  }
  (std::make_index_sequence<Count>{});
}

/// Applies f to the registers of packs, one after the other.
template <class F, class Batch, std::size_t Count, class... Batches>
[[gnu::always_inline]] inline auto each(F f, const Pack<Batch, Count>& first, const Pack<Batches, Count>&... rest) {
  return make_pack<Count>([&](auto i) { return f(first.r[i], rest.r[i]...); });
}

template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator+(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::plus<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator-(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::minus<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator*(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::multiplies<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator/(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::divides<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator<(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::less<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator>(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::greater<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator<=(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::less_equal<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator&(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::bit_and<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator|(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::bit_or<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator^(const Pack<Batch, Count>& a, const Pack<Batch, Count>& b) {
  return each(std::bit_xor<>{}, a, b);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator-(const Pack<Batch, Count>& a) {
  return each(std::negate<>{}, a);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator!(const Pack<Batch, Count>& mask) {
  return each(std::bit_not<>{}, mask);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator<<(const Pack<Batch, Count>& words, int bits) {
  return each([bits](const Batch& x) { return Batch(x << bits); }, words);
}
template <class Batch, std::size_t Count>
[[gnu::always_inline]] inline auto operator>>(const Pack<Batch, Count>& words, int bits) {
  return each([bits](const Batch& x) { return Batch(x >> bits); }, words);
}

template <class Arch, std::size_t Count>
using RealPack = Pack<xsimd::batch<double, Arch>, Count>;
template <class Arch, std::size_t Count>
using MaskPack = Pack<xsimd::batch_bool<double, Arch>, Count>;
template <class Arch, std::size_t Count>
using WordsPack = Pack<xsimd::batch<std::uint64_t, Arch>, Count>;

template <class Arch, std::size_t Count>
struct RealTraits<RealPack<Arch, Count>> {
  using Mask = MaskPack<Arch, Count>;
  using Words = WordsPack<Arch, Count>;
  using Narrow = RealPack<Arch, 1>;
  static constexpr std::size_t width = xsimd::batch<double, Arch>::size;
  static constexpr std::size_t lanes = width * Count;

  [[gnu::always_inline]] static RealPack<Arch, Count> load(const double* from) {
    return make_pack<Count>([&](auto i) { return xsimd::batch<double, Arch>::load_unaligned(from + i * width); });
  }
};

template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> select(const MaskPack<Arch, Count>& mask,
                                                           const RealPack<Arch, Count>& a,
                                                           const RealPack<Arch, Count>& b) {
  return each([](auto m, auto x, auto y) { return xsimd::select(m, x, y); }, mask, a, b);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline std::uint32_t lane_bits(const MaskPack<Arch, Count>& mask) {
  constexpr std::size_t width = RealTraits<RealPack<Arch, Count>>::width;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < Count; ++i) bits |= native_lane_bits(mask.r[i]) << (i * width);
  return bits;
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline bool any(const MaskPack<Arch, Count>& mask) {
  return lane_bits(mask) != 0;
}

template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> mul_add(const RealPack<Arch, Count>& a,
                                                            const RealPack<Arch, Count>& b,
                                                            const RealPack<Arch, Count>& c) {
  return each([](auto x, auto y, auto z) { return native_mul_add(x, y, z); }, a, b, c);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> neg_mul_add(const RealPack<Arch, Count>& a,
                                                                const RealPack<Arch, Count>& b,
                                                                const RealPack<Arch, Count>& c) {
  return each([](auto x, auto y, auto z) { return native_neg_mul_add(x, y, z); }, a, b, c);
}

#if defined(__AVX512F__)

// With 512-bit registers the divider and the square root unit are several times slower than refining a seed.
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> fix(const RealPack<Arch, Count>& value,
                                                        const RealPack<Arch, Count>& x, long long table) {
  return each([table](auto v, auto argument) { return native_fix(v, argument, table); }, value, x);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> reciprocal(const RealPack<Arch, Count>& a) {
  const auto seed = each([](auto x) { return native_reciprocal_seed(x); }, a);
  return fix(refine_reciprocal(a, seed), a, fix_reciprocal);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RootAndInverse<RealPack<Arch, Count>> root_and_inverse(const RealPack<Arch, Count>& a) {
  const auto seed = each([](auto x) { return native_inverse_root_seed(x); }, a);
  const auto [root, inverse] = refine_root_and_inverse(a, seed);
  return {fix(root, a, fix_root), fix(inverse, a, fix_root_inverse)};
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> sqrt(const RealPack<Arch, Count>& a) {
  return root_and_inverse(a).root;
}

#else

template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> reciprocal(const RealPack<Arch, Count>& a) {
  return RealPack<Arch, Count>(1.0) / a;
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> sqrt(const RealPack<Arch, Count>& a) {
  return each([](auto x) { return xsimd::sqrt(x); }, a);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RootAndInverse<RealPack<Arch, Count>> root_and_inverse(const RealPack<Arch, Count>& a) {
  const RealPack<Arch, Count> root = sqrt(a);
  return {root, reciprocal(root)};
}

#endif

template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> abs(const RealPack<Arch, Count>& a) {
  return each([](auto x) { return xsimd::abs(x); }, a);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> max(const RealPack<Arch, Count>& a,
                                                        const RealPack<Arch, Count>& b) {
  return each([](auto x, auto y) { return native_max(y, x); }, a, b);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline MaskPack<Arch, Count> is_finite(const RealPack<Arch, Count>& a) {
  return abs(a) <= RealPack<Arch, Count>(std::numeric_limits<double>::max());
}

template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline WordsPack<Arch, Count> bits_of(const RealPack<Arch, Count>& a) {
  using Batch = xsimd::batch<std::uint64_t, Arch>;
  using Register = typename Batch::register_type;
  return each([](auto x) { return Batch(std::bit_cast<Register>(x)); }, a);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline RealPack<Arch, Count> from_bits(const WordsPack<Arch, Count>& a) {
  using Batch = xsimd::batch<double, Arch>;
  using Register = typename Batch::register_type;
  return each([](auto x) { return Batch(std::bit_cast<Register>(x)); }, a);
}
template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline WordsPack<Arch, Count> multiply_low_words(const WordsPack<Arch, Count>& a,
                                                                        const WordsPack<Arch, Count>& b) {
  return each([](auto x, auto y) { return native_multiply_low_words(x, y); }, a, b);
}

template <class Arch, std::size_t Count>
[[gnu::always_inline]] inline void store(double* to, const RealPack<Arch, Count>& value) {
  for (std::size_t i = 0; i < Count; ++i) value.r[i].store_unaligned(to + i * xsimd::batch<double, Arch>::size);
}

/// The pack that kernels of this source file use.
using NativeReal = RealPack<xsimd::default_arch, 2>;

}  // namespace ridgeloc::core
