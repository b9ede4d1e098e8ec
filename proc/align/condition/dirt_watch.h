// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "proc/align/condition/dirt_reference.h"
#include "proc/align/condition/small_marks.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// Dirtiness of the ball. Shares are of the judged part of the ball's picture, [0, 1].
struct Dirt {
  /// Share covered by spots and scratches that the clean ball did not have.
  double contamination = 0;
  double largest_spot = 0;  ///< diameter of a circle with the area of the largest spot, ball radii
  /// Share whose detail has kept its pattern but is weaker: a film, or the focus (see
  /// measure_focus).
  double dulled = 0;
  double judged = 0;  ///< share of the ball's picture that is bright enough to be judged
};

struct DirtSettings {
  double window = 1800;  ///< s; a mark that is there for less than half of it is not dirt
  /// Largest width of a spot, ball radii: anything wider belongs to the room.
  double widest = 0.15;
};

/// Distinguishes dirt on the ball from reflections, for a fixed camera. A mark is dirt if it is
/// small, was not there on the clean ball, does not move within half the window, is there in most
/// of the light that fell in that time, is not squeezed along the radius as reflections are, and
/// lies where the room around it is unchanged.
///
/// One picture is not enough to decide. These count as dirt although they are not: a new small
/// thing in the room that does not move, unless it is near the limb; small reflections in a light
/// that the reference does not cover; a camera that has moved: learn anew after that. These are
/// dirt and do not count: spots wider than `widest`, scratches along the limb in the outer part,
/// spots where the reflection is black or where the clean ball showed such marks, marks that are
/// overexposed, and all dirt where something large has been moved for good: `judged` is the share
/// that is left; learn anew after cleaning. Counts must be proportional to light or grow with it
/// from 0: a picture of temperatures shows only differences of an eighth of the absolute
/// temperature.
///
/// Holds 4 MB at most. Thread-bound.
class DirtWatch {
 public:
  static constexpr std::size_t kLooks = 9;  ///< looks per window

  /// For pictures of width x height. Error: an outline outside of them, settings out of range.
  static Result<DirtWatch> make(int width, int height, const optics::Outline& outline,
                                const DirtSettings& settings = {});

  /// Sets the clean ball's appearance. Error: check_reference()'s.
  Result<> use(const DirtReference& reference);

  /// Resets to the initial state, without a reference and without looks.
  void forget();

  /// Accepts every picture of the camera, at any rate; `now` in seconds of a monotonic clock.
  /// Evaluates one picture per kLooks-th part of the window, which takes some tens of milliseconds;
  /// returns at once for the others.
  void observe(const Picture& picture, double now);

  /// Error: the reason why nothing is measured: no reference yet, too few pictures so far,
  /// darkness.
  const Result<Dirt>& dirt() const { return dirt_; }

  /// A reference from the latest window, in which the ball must have been clean. Everything that
  /// happened in it, lights, tools, sparks, is part of the reference. Error: too few pictures so
  /// far.
  Result<DirtReference> learnt() const;

 private:
  DirtWatch(const cv::Size& size, const optics::Outline& outline, const DirtSettings& settings)
      : size_(size), outline_(outline), settings_(settings) {}

  struct Look {
    double time;
    SmallMarks marks;
  };

  Result<SmallMarks> look(const Picture& picture) const;
  void forget(double before);
  Result<Dirt> judge() const;

  cv::Size size_;
  optics::Outline outline_;
  DirtSettings settings_;
  std::optional<DirtReference> reference_;
  std::deque<Look> looks_;
  std::optional<double> last_look_;
  std::string trouble_;  ///< the latest look's error
  Result<Dirt> dirt_ = fail("no picture of the ball so far");
};

}  // namespace orbwatch::align
