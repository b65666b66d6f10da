#pragma once

#include <cstdint>

/// The arguments whose reciprocals and roots are hardest to round to double precision: all that come within a few
/// 2^-106 (relative) of the middle between two neighbours. An error of that size anywhere else changes nothing.
namespace ridgeloc::tests {

/// Fractions X, x = X 2^-52 in [1, 2): the divisors X of 2^106 + k, |k| <= 4, whose quotient M is odd and in
/// (2^53, 2^54), so that 1 / x is k 2^-106 from the middle M 2^-54. The first has a fraction that is all ones.
inline constexpr std::uint64_t hard_reciprocals[] = {
    0x1fffffffffffff, 0x1ffffff8000001, 0x1024a3bd98da02, 0x10699d36aec84e, 0x109107683ee29e, 0x110af85de838ce,
    0x11d3799c32581e, 0x11f98ea5d9b262, 0x12bf5907e316d2, 0x12e93952a2ed6e, 0x130a0dd90e13a2, 0x134d8fe343ef42,
    0x13a324a526d5ee, 0x14a6fb45f5d782, 0x14cad5a5fa03ee, 0x155f2490c86132, 0x163baaac17d1e2, 0x163dd0554d0122,
    0x17641c46f799ee, 0x178cb7d5d6e322, 0x17f52093014f0e, 0x184a12efef626e, 0x199e1b447e99c2, 0x19f142d24e1352,
    0x1a0b8ffffcbe8e, 0x1a6f41dab98cb2, 0x1b227794e85702, 0x1bea3278b789d2, 0x1d5b9032f086be, 0x1da210daeb138e,
    0x1de441d5331432, 0x1e20adbc4078a2, 0x1e756f08df1792, 0x1ef7930608393e, 0x1014ca35e947b6, 0x10af911aa26396,
    0x10d03f8a57cc76, 0x110d10000221a2, 0x1125e52b034982, 0x115efb8b10aa42, 0x120a8f5bbf2106, 0x12af4d6bc06922,
    0x1379cb88f092f2, 0x13a7a1d01d1ec2, 0x13d75d54b37492, 0x1403e897077b16, 0x156a8cb0234262, 0x159aa11aaecb86,
    0x16026c81a85766, 0x16d6422e5cf246, 0x16f0f27bf434d6, 0x16fae7ba173812, 0x1806c89fcb9452, 0x181efe51ead722,
    0x18401cbcdb5596, 0x1960a45d1a71e6, 0x1a149bad85de72, 0x1a2ce4d7478a06, 0x1aa7c88ee59082, 0x1ae6849e786ad2,
    0x1c2693dcf34742, 0x1c4d3aabd478f6, 0x1c69bf28eba166, 0x1de4a0d00fa9b2, 0x1e8d517d09c5c2, 0x1e9a9473949bf6,
    0x1f65fad23b0d86, 0x1f739bd459bea2, 0x10aadc6f562fdc, 0x10ed85c351e224, 0x12d2d2d2d2d2d4, 0x12e3c6a0509ca4,
    0x132160ccc0848c, 0x13541c0067f83c, 0x14873ecade304c, 0x15555555555554, 0x172f10bf899124, 0x178d42e524dcdc,
    0x194ab05a4ecedc, 0x194c4511fa3124, 0x199d2b42ffe9f4, 0x1c36899addce3c, 0x1c384d119331c4, 0x1c928b5b9dc714,
    0x1fe24bffeb8794, 0x1ffb8a8b628dbc};

/// Fractions X, x = X 2^-52 in [1, 4): X 2^54 = M^2 - k for an odd M in (2^53, 2^54), |k| < 64, k = 1 modulo 8 as for
/// all odd squares: sqrt(x) is about k 2^-107 from the middle M 2^-53.
inline constexpr std::uint64_t hard_roots[] = {
    0x10000000000001, 0x3ffffffffffffe, 0x1d407bb3641da5, 0x2b72a6892e5fc4, 0x10000000000003, 0x3ffffffffffffa,
    0x12b035c1197f48, 0x1256565cadcbf4, 0x1e99893042c2cb, 0x29d6bf0bcf0752, 0x10000000000005, 0x3ffffffffffff6,
    0x1ba44c2a0737a2, 0x1a881d1831fabd, 0x2ee907a6f9c40a, 0x1270ac7cec9d2a, 0x1283741a1bef08, 0x1955d8279a3c0f,
    0x30888111b7b96a, 0x10000000000007, 0x3ffffffffffff2, 0x1732b9a374ddce, 0x235932abfb21a4, 0x11dad9cfe3d12a};

}  // namespace ridgeloc::tests
