// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A light that is small in the ball's picture: a melt pool, a lamp at the tool's tip or far away.
struct SmallLight {
  optics::Vec2 centre;    ///< px, centre of its light
  double brightness = 0;  ///< highest counts above its surroundings
};

inline constexpr std::size_t kMostSmallLights = 32;

/// Finds the lights in the ball's mean picture over `pictures`, in which sparks vanish: at most a
/// twelfth of its radius wide, the brightest first, at most kMostSmallLights. None is found next to
/// the limb. Reentrant. Error: pictures of different sizes or none, an outline that lies outside of
/// them, no such light.
Result<std::vector<SmallLight>> small_lights(std::span<const Picture> pictures,
                                             const optics::Outline& outline);

/// The brightest light of `here` that is at none of its places elsewhere: the tool's, which has
/// moved, unlike lamps. nullopt: all of them are elsewhere, too. Two lights within a hundredth of
/// the ball's radius, or 2 px, are at one place. Reentrant.
std::optional<optics::Vec2> moved_light(std::span<const SmallLight> here,
                                        std::span<const std::vector<SmallLight>> elsewhere,
                                        const optics::Outline& outline);

}  // namespace orbwatch::align
