#pragma once

#include <optional>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A light that is small as the ball shows it: a melt pool, a lamp at the tool's tip or far away.
struct SmallLight {
  optics::Vec2 centre;    ///< px, of its light
  double brightness = 0;  ///< counts above its surroundings, its highest
};

inline constexpr std::size_t kMostSmallLights = 32;

/// The lights that a ball shows on the mean of `pictures`, in which sparks vanish: not wider than a
/// twelfth of its radius, the brightest first, at most kMostSmallLights. Next to the limb none is
/// found. Reentrant. Error: pictures of different sizes or none, an outline that lies outside of
/// them, no such light.
Result<std::vector<SmallLight>> small_lights(std::span<const Picture> pictures,
                                             const optics::Outline& outline);

/// The brightest light of `here` that is at none of its places elsewhere: the tool's, which has
/// moved, where lamps have not. None: all of them are elsewhere, too. Within a hundredth of the
/// ball's radius, or 2 px, two lights are at one place. Reentrant.
std::optional<optics::Vec2> moved_light(std::span<const SmallLight> here,
                                        std::span<const std::vector<SmallLight>> elsewhere,
                                        const optics::Outline& outline);

}  // namespace orbwatch::align
