#pragma once

#include <deque>
#include <optional>

#include "proc/align/condition/dirt_reference.h"
#include "proc/align/condition/small_marks.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// How dirty the ball is. Shares are of the judged part of the ball's picture, [0, 1].
struct Dirt {
  double contamination = 0;  ///< share that spots and scratches cover which were not there
  double largest_spot = 0;   ///< diameter of a circle as large as the largest one, ball radii
  /// Share whose detail is as it was but weaker: a film, or the focus (see measure_focus).
  double dulled = 0;
  double judged = 0;  ///< share of the ball's picture that is bright enough to be judged
};

struct DirtSettings {
  double window = 1800;  ///< s; what is not there for half of it is no dirt
  double widest = 0.15;  ///< of a spot, ball radii: what is wider belongs to the room
};

/// Tells dirt on the ball from what the ball reflects, with a fixed camera. Dirt is what is small,
/// was not there on the clean ball, does not move within half the window, is there in most of the
/// light that fell in that time, is not squeezed along the radius as reflected things are, and lies
/// where the room around it is as it was.
///
/// One picture cannot tell everything. These count as dirt although they are none: a new small
/// thing in the room that does not move, unless it stands near the limb; small reflections in a
/// light that the reference does not know; a camera that has moved: learn anew after that. These
/// are dirt and do not count: spots wider than `widest`, scratches along the limb in the outer
/// part, spots where the reflection is black or where the clean ball showed such marks, marks that
/// are overexposed, and all of it where something large has been moved for good: `judged` says how
/// much is left; learn anew after cleaning. Counts must be proportional to light or grow with it
/// from 0: in a picture of temperatures only what differs by an eighth of the absolute one is seen.
///
/// Holds 4 MB at most. Thread-bound.
class DirtWatch {
 public:
  static constexpr std::size_t kLooks = 9;  ///< in a window

  /// For pictures of that size. Error: an outline outside of them, settings out of range.
  static Result<DirtWatch> make(int width, int height, const optics::Outline& outline,
                                const DirtSettings& settings = {});

  /// What the ball shows when it is clean. Error: no such maps.
  Result<> use(const DirtReference& reference);

  /// As new: without a reference, and without what was seen.
  void forget();

  /// To be called with any picture of the camera as often as it suits, `now` in seconds of a
  /// monotonic clock. Looks at one each kLooks-th part of the window, which takes some tens of
  /// milliseconds; returns at once for the others.
  void observe(const Picture& picture, double now);

  /// Error: why it is not measured: nothing learnt yet, too few pictures so far, darkness.
  const Result<Dirt>& dirt() const { return dirt_; }

  /// A reference from the latest window, in which the ball must have been clean. Whatever happened
  /// in it, lights, tools, sparks, is known from then on. Error: too few pictures so far.
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
  std::string trouble_;  ///< of the latest look
  Result<Dirt> dirt_ = fail("no picture of the ball so far");
};

}  // namespace orbwatch::align
