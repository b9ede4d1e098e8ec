// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "app/model/status/field.h"
#include "proc/signals/signals.h"

/// Part of the status of a camera that is found beside the frame path: see status.h.
namespace orbwatch::app {

/// Level of a watched figure of a camera relative to its limits. The numbers go to the PLC: append,
/// never renumber.
enum class WatchLevel : std::uint8_t {
  NotMeasured = 0,  ///< not watched, no picture, too dark, or nothing learnt yet
  Good = 1,
  Warning = 2,
  Alarm = 3,
};

/// The one place of the operator's text for each level. Empty for a number that is none.
constexpr std::string_view operator_text(WatchLevel level) {
  switch (level) {
    case WatchLevel::NotMeasured:
      return "not measured";
    case WatchLevel::Good:
      return "good";
    case WatchLevel::Warning:
      return "beyond its warning limit";
    case WatchLevel::Alarm:
      return "beyond its alarm limit";
  }
  return {};
}

/// State of watching a camera's alignment: a WatchLevel, or the reason why there is none. The
/// numbers go to the PLC: append, never renumber.
enum class AlignmentLevel : std::uint8_t {
  NotMeasured = 0,  ///< not watched, or no picture yet
  Good = 1,
  Warning = 2,
  Alarm = 3,
  NotRegistered = 4,  ///< the rig has no registration
  Learning = 5,       ///< a motion now moves the zero, too
  NotVisible = 6,
};

/// The same level by its number.
constexpr AlignmentLevel alignment_level(WatchLevel level) {
  return static_cast<AlignmentLevel>(level);
}

/// The one place of the operator's text for each level. Empty for a number that is none.
constexpr std::string_view operator_text(AlignmentLevel level) {
  switch (level) {
    case AlignmentLevel::NotMeasured:
    case AlignmentLevel::Good:
    case AlignmentLevel::Warning:
    case AlignmentLevel::Alarm:
      return operator_text(static_cast<WatchLevel>(level));
    case AlignmentLevel::NotRegistered:
      return "not registered, and left out of merged and measured views";
    case AlignmentLevel::Learning:
      return "learning the zero of its drift: the ball must rest";
    case AlignmentLevel::NotVisible:
      return "not measured, the ball is not visible: dark, overexposed, hidden or elsewhere";
  }
  return {};
}

/// The stated outline of a camera's ball compared with the ball found in its picture. The numbers
/// go to the PLC: append, never renumber.
enum class OutlineState : std::uint8_t {
  Unknown = 0,
  Aligned = 1,
  NotAligned = 2,
};

/// The one place of the operator's text for each state. Empty for a number that is none.
constexpr std::string_view operator_text(OutlineState state) {
  switch (state) {
    case OutlineState::Unknown:
      return "not known: no zero yet, or the ball is not found for sure";
    case OutlineState::Aligned:
      return "aligned with the ball that is found";
    case OutlineState::NotAligned:
      return "not aligned with the ball that is found";
  }
  return {};
}

/// State of the alignment requested last. The numbers go to the PLC: append, never renumber.
enum class ProposalState : std::uint8_t {
  None = 0,
  Working = 1,
  Ready = 2,
  Refused = 3,
};

/// The one place of the operator's text for each state. Empty for a number that is none.
constexpr std::string_view operator_text(ProposalState state) {
  switch (state) {
    case ProposalState::None:
      return "nothing is proposed";
    case ProposalState::Working:
      return "an alignment or a point is being computed";
    case ProposalState::Ready:
      return "an alignment is proposed: accept or discard it";
    case ProposalState::Refused:
      return "none was found; the log has the reason";
  }
  return {};
}

/// Its name, for programs. Empty for a number that is none.
constexpr std::string_view name_of(ProposalState state) {
  constexpr std::array<std::string_view, 4> kNames{"none", "working", "ready", "refused"};
  const auto index = static_cast<std::size_t>(state);
  return index < kNames.size() ? kNames[index] : std::string_view{};
}

#define ORBWATCH_WATCH_FIGURES(FIELD)                                                              \
  FIELD(AlignmentLevel, alignment, kCode,                                                          \
        "State of watching the alignment: the ball's position compared with its zero, which is "   \
        "learnt after an alignment")                                                               \
  FIELD(double, drift_error, kAngle,                                                               \
        "Error of the directions that views show, rms, since the zero was learnt")                 \
  FIELD(double, drift_shift, kPercent,                                                             \
        "Shift of the ball's picture from its zero, relative to its radius")                       \
  FIELD(WatchLevel, focus, kCode, "Sharpness of the reflection in the ball")                       \
  FIELD(double, blur, kBlur,                                                                       \
        "Blur of the reflection in the ball: sigma of a Gaussian, pixel size included")            \
  FIELD(WatchLevel, cleanliness, kCode, "Cleanliness of the ball")                                 \
  FIELD(double, contamination, kPercent,                                                           \
        "Share of the ball's picture under spots and scratches that appeared after it was learnt") \
  FIELD(ProposalState, proposal, kCode, "State of the alignment requested last")                   \
  FIELD(double, proposal_error, kAngle,                                                            \
        "One sigma of the directions of the proposed alignment, estimated from its residuals; "    \
        "not valid without a proposal, and for detect_ball")                                       \
  FIELD(std::uint64_t, marked_points, kCount,                                                      \
        "Points that mark_point added for place_camera since the start")

/// Watch figures whose places follow those of the link.
#define ORBWATCH_OUTLINE_FIGURES(FIELD)                                                        \
  FIELD(OutlineState, outline_check, kCode,                                                    \
        "The stated outline compared with the ball found in the picture of the zero")          \
  FIELD(double, outline_offset, kPercent,                                                      \
        "Largest distance between the stated outline and that of the ball found, relative to " \
        "its radius")                                                                          \
  FIELD(double, outline_offset_px, kOffset,                                                    \
        "Largest distance between the stated outline and that of the ball found")

inline constexpr Quantity kOffset{"px", 0.01, 0, 100000};
inline constexpr Quantity kAngle{"deg", 0.001, 0, 180};
inline constexpr Quantity kPercent{"%", 0.01, 0, 10000};
inline constexpr Quantity kBlur{"px", 0.01, 0, 1000};

/// Value of a figure before its first measurement.
template <class T>
inline constexpr T kNotMeasured{};
template <>
inline constexpr double kNotMeasured<double> = signals::kNotValid;
#define ORBWATCH_WATCH_MEMBER(type, name, quantity, description) type name = kNotMeasured<type>;

/// Supervision of a camera outside the frame path; a number is not valid while its level is
/// NotMeasured.
struct CameraWatchStatus {
  ORBWATCH_WATCH_FIGURES(ORBWATCH_WATCH_MEMBER)
  ORBWATCH_OUTLINE_FIGURES(ORBWATCH_WATCH_MEMBER)
};

/// See for_each_field() of a part in status.h.
template <class Visit>
constexpr void for_each_field(std::type_identity<CameraWatchStatus>, Visit&& visit) {
  using Part = CameraWatchStatus;
  ORBWATCH_WATCH_FIGURES(ORBWATCH_VISIT_FIELD)
  ORBWATCH_OUTLINE_FIGURES(ORBWATCH_VISIT_FIELD)
}

}  // namespace orbwatch::app
