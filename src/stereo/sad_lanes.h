// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Vectors of 8 and 16 bit integers as wide as the flags allow with which the including source is compiled.

#include <cstdint>

#ifdef __AVX2__
#include <immintrin.h>
#else
#include <opencv2/core/hal/intrin.hpp>
#endif

namespace cabinet_articulation::core {
namespace {

#ifdef __AVX2__

using ByteLanes = __m256i;
using ShortLanes = __m256i;
constexpr int kByteLanes = 32;

inline ByteLanes allBytes(std::uint8_t value) { return _mm256_set1_epi8(static_cast<char>(value)); }
inline ShortLanes allShorts(std::int16_t value) { return _mm256_set1_epi16(value); }
inline ByteLanes load(const std::uint8_t* from) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)); }
inline ShortLanes load(const std::int16_t* from) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(from)); }
inline void store(std::int16_t* to, ShortLanes value) { _mm256_store_si256(reinterpret_cast<__m256i*>(to), value); }
inline ShortLanes plus(ShortLanes a, ShortLanes b) { return _mm256_add_epi16(a, b); }
inline ShortLanes minus(ShortLanes a, ShortLanes b) { return _mm256_sub_epi16(a, b); }
inline ShortLanes smaller(ShortLanes a, ShortLanes b) { return _mm256_min_epi16(a, b); }

inline ByteLanes distance(ByteLanes a, ByteLanes b) { return _mm256_or_si256(_mm256_subs_epu8(a, b), _mm256_subs_epu8(b, a)); }

/// a - b, which must lie within -128 and 127, as 16 bit numbers.
inline void wideDifference(ByteLanes a, ByteLanes b, ShortLanes* low, ShortLanes* high) {
  const ByteLanes difference = _mm256_sub_epi8(a, b);
  *low = _mm256_cvtepi8_epi16(_mm256_castsi256_si128(difference));
  *high = _mm256_cvtepi8_epi16(_mm256_extracti128_si256(difference, 1));
}

inline int smallest(ShortLanes lanes) {
  const __m128i eight = _mm_min_epi16(_mm256_castsi256_si128(lanes), _mm256_extracti128_si256(lanes, 1));
  return _mm_cvtsi128_si32(_mm_minpos_epu16(eight)) & 0xFFFF;
}

/// One bit for each lane, the first lowest: whether it is negative.
inline std::uint32_t negative(ShortLanes low, ShortLanes high) {
  const ByteLanes bytes = _mm256_permute4x64_epi64(_mm256_packs_epi16(low, high), 0xD8);
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(bytes));
}

#else

using ByteLanes = cv::v_uint8x16;
using ShortLanes = cv::v_int16x8;
constexpr int kByteLanes = 16;

inline ByteLanes allBytes(std::uint8_t value) { return cv::v_setall_u8(value); }
inline ShortLanes allShorts(std::int16_t value) { return cv::v_setall_s16(value); }
inline ByteLanes load(const std::uint8_t* from) { return cv::v_load(from); }
inline ShortLanes load(const std::int16_t* from) { return cv::v_load_aligned(from); }
inline void store(std::int16_t* to, const ShortLanes& value) { cv::v_store_aligned(to, value); }
inline ShortLanes plus(const ShortLanes& a, const ShortLanes& b) { return cv::v_add_wrap(a, b); }
inline ShortLanes minus(const ShortLanes& a, const ShortLanes& b) { return cv::v_sub_wrap(a, b); }
inline ShortLanes smaller(const ShortLanes& a, const ShortLanes& b) { return cv::v_min(a, b); }
inline ByteLanes distance(const ByteLanes& a, const ByteLanes& b) { return cv::v_absdiff(a, b); }

inline void wideDifference(const ByteLanes& a, const ByteLanes& b, ShortLanes* low, ShortLanes* high) {
  cv::v_expand(cv::v_reinterpret_as_s8(cv::v_sub_wrap(a, b)), *low, *high);
}

inline int smallest(const ShortLanes& lanes) { return cv::v_reduce_min(lanes); }

inline std::uint32_t negative(const ShortLanes& low, const ShortLanes& high) {
  return static_cast<std::uint32_t>(cv::v_signmask(cv::v_pack(low, high)));
}

#endif

}  // namespace
}  // namespace cabinet_articulation::core
