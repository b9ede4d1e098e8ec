// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "app/daemon/recordings/recorded_site.h"
#include "app/daemon/replay/comparison.h"
#include "app/daemon/replay/recorded_sets.h"
#include "app/daemon/replay/set_meter.h"
#include "app/files/resolve.h"
#include "app/ports/recorder/messages.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Time in which rates and delays of alarms forget what was before the recording, s. A recording
/// that begins with the first frame set needs none.
inline constexpr double kSettle = 2;

/// Chooses recipes in place of those of the recorded configuration. Empty function: none.
using RecipeChoice = std::function<Result<OtherRecipes>(const files::Resolved& recorded)>;

/// A recorded frame set and the state that was computed of it again.
struct ReplayedSet {
  std::uint64_t utc = 0;  ///< its stamp, ns since 1970
  recorder::ProcessState recorded, computed;
};

/// Measures the frame sets of a recording again, with the configuration in it: the same for the
/// command and for the page. Thread-bound.
class Replay {
 public:
  /// `threads`: workers beside the calling thread. Errors: of the recording and its configuration,
  /// and those of `choose`.
  static Result<Replay> open(const std::filesystem::path& recording, const RecipeChoice& choose,
                             std::size_t threads);

  /// The next frame set that has pictures; nullopt behind the last one. Errors: damaged; a set that
  /// was measured with an unknown recipe.
  Result<std::optional<ReplayedSet>> next();

  /// Regions that are measured in pictures which the recorder coded as JPEG.
  JpegQualities jpeg_regions() const;
  std::size_t without_pictures() const { return sets_.without_pictures(); }
  /// Frame sets so far, also those without pictures, and of the whole recording; 0: not stated.
  std::size_t done() const { return sets_.states(); }
  std::size_t of() const { return sets_.stated(); }
  /// Stamp of the recording's last message, ns since 1970.
  std::uint64_t end() const { return sets_.end(); }

 private:
  Replay(files::Resolved site, RecordedSets sets, SetMeter meter)
      : site_(std::move(site)), sets_(std::move(sets)), meter_(std::move(meter)) {}

  files::Resolved site_;
  RecordedSets sets_;
  SetMeter meter_;
};

/// Stamp of the first frame set that is compared, ns since 1970, after `settle` s, or kSettle s
/// unless the recording has the first frame set. Reentrant.
std::uint64_t comparison_begin(const ReplayedSet& first, std::optional<double> settle);

}  // namespace orbwatch::app::daemon
