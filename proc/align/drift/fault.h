// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// Reasons why drift is not measured, for an operator.
namespace orbwatch::align::fault {

inline constexpr std::string_view kNoReference = "the first pictures are still being collected";
inline constexpr std::string_view kOverexposed = "the ball is overexposed";
inline constexpr std::string_view kDark = "it is too dark";
inline constexpr std::string_view kFlat = "the ball shows too little texture";
inline constexpr std::string_view kOutside = "the ball is outside of the picture";
inline constexpr std::string_view kElsewhere =
    "the ball does not show what the reference shows: something hides it, the light is another, or "
    "it is elsewhere";

}  // namespace orbwatch::align::fault
