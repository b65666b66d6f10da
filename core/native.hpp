#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

/// What xsimd lacks, for one register: the only intrinsics of the project.
namespace ridgeloc::core {

template <class Arch>
using RealRegister = xsimd::batch<double, Arch>;
template <class Arch>
using WordsRegister = xsimd::batch<std::uint64_t, Arch>;

/// Bit i tells whether the mask holds in lane i.
template <class Arch>
[[gnu::always_inline]] inline std::uint32_t native_lane_bits(const xsimd::batch_bool<double, Arch>& mask) {
#if defined(__AVX512F__)
  return static_cast<std::uint32_t>(static_cast<__mmask8>(mask));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_pd(mask));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_pd(mask));
#else
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < mask.size; ++lane) bits |= (mask.get(lane) ? 1U : 0U) << lane;
  return bits;
#endif
}

/// a b + c and c - a b, fused where the instruction set can; the xsimd of Debian 12 does not fuse on AVX-512.
template <class Arch>
[[gnu::always_inline]] inline RealRegister<Arch> native_mul_add(const RealRegister<Arch>& a,
                                                                const RealRegister<Arch>& b,
                                                                const RealRegister<Arch>& c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_pd(a, b, c);
#elif defined(__AVX2__)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}
template <class Arch>
[[gnu::always_inline]] inline RealRegister<Arch> native_neg_mul_add(const RealRegister<Arch>& a,
                                                                    const RealRegister<Arch>& b,
                                                                    const RealRegister<Arch>& c) {
#if defined(__AVX512F__)
  return _mm512_fnmadd_pd(a, b, c);
#elif defined(__AVX2__)
  return _mm256_fnmadd_pd(a, b, c);
#else
  return c - a * b;
#endif
}

/// a where a > b, b elsewhere, NaN included.
template <class Arch>
[[gnu::always_inline]] inline RealRegister<Arch> native_max(const RealRegister<Arch>& a, const RealRegister<Arch>& b) {
#if defined(__AVX512F__)
  return _mm512_max_pd(a, b);
#elif defined(__AVX2__)
  return _mm256_max_pd(a, b);
#elif defined(__SSE2__)
  return _mm_max_pd(a, b);
#else
  return xsimd::select(a > b, a, b);
#endif
}

/// Product of the lower halves of every lane.
template <class Arch>
[[gnu::always_inline]] inline WordsRegister<Arch> native_multiply_low_words(const WordsRegister<Arch>& a,
                                                                            const WordsRegister<Arch>& b) {
#if defined(__AVX512F__)
  return _mm512_mul_epu32(a, b);
#elif defined(__AVX2__)
  return _mm256_mul_epu32(a, b);
#elif defined(__SSE2__)
  return _mm_mul_epu32(a, b);
#elif defined(__ARM_NEON)
  return vmull_u32(vmovn_u64(a), vmovn_u64(b));
#else
  const WordsRegister<Arch> low_word(0xffffffffU);
  return (a & low_word) * (b & low_word);
#endif
}

#if defined(__AVX512F__)

/// The processor's approximations to 14 bits.
template <class Arch>
[[gnu::always_inline]] inline RealRegister<Arch> native_reciprocal_seed(const RealRegister<Arch>& x) {
  return _mm512_rcp14_pd(x);
}
template <class Arch>
[[gnu::always_inline]] inline RealRegister<Arch> native_inverse_root_seed(const RealRegister<Arch>& x) {
  return _mm512_rsqrt14_pd(x);
}

/// Tables of what replaces a value where x is zero or infinite: four bits for each class of x.
inline constexpr long long fix_reciprocal = 0x6LL << 8 | 0x7LL << 16 | 0x8LL << 20;  // 0: inf, -inf: -0, inf: 0
inline constexpr long long fix_root = 0x1LL << 8 | 0x1LL << 20;                      // 0 and inf: x itself
inline constexpr long long fix_root_inverse = 0x6LL << 8 | 0x8LL << 20;              // 0: inf, inf: 0

template <class Arch>
[[gnu::always_inline]] inline RealRegister<Arch> native_fix(const RealRegister<Arch>& value,
                                                            const RealRegister<Arch>& x, long long table) {
  return _mm512_fixupimm_pd(value, x, _mm512_set1_epi64(table), 0);
}

#endif

}  // namespace ridgeloc::core
