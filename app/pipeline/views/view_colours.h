// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/sink/view.h"
#include "app/pipeline/views/view_plan.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::pipeline {

/// Colours that a view shows a source in.
struct ShownColours {
  SourceColours stated;
  remap::ColourMap map;
};

/// Chosen colours by source; null, or beyond the end: the planned ones.
using ChosenColours = std::span<const std::unique_ptr<const ShownColours>>;

/// Other colours for the one-channel cameras of a view while frames run, of measured views, too:
/// only the picture changes that people look at. The caller makes the tables and frees those that
/// were replaced; the frame path exchanges them between two sets.
/// Thread rule: set_map, set_range and adopt on any thread, exchange on the pipeline's.
class ViewColours {
 public:
  /// `views` by index; `maps` by SourceColours::map.
  ViewColours(std::span<const ViewPlan> views, std::vector<remap::ColourMap::Table> maps);

  /// ArgumentOutOfRange: no such view, source or map; NotPossible: the camera has colours of its
  /// own.
  CommandResult set_map(std::size_t view, std::size_t source, std::size_t map);
  /// First below last, as SourceColours. Results as set_map().
  CommandResult set_range(std::size_t view, std::size_t source, const std::array<double, 2>& range);

  /// The view's sources deliver other formats from now on.
  void adopt(std::size_t view, std::span<const ViewSource> sources);

  /// Between two frame sets: takes up what was asked for since. Valid until the next call for this
  /// view. Neither allocates nor frees.
  ChosenColours exchange(std::size_t view);

 private:
  using Tables = std::array<std::unique_ptr<const ShownColours>, remap::kMaxSources>;
  struct Source {
    hal::StreamFormat format;
    SourceColours colours;  ///< as asked for last, or as configured
    bool is_chosen = false;
  };
  struct Slot {
    std::vector<Source> sources;                    ///< under requesting_
    Tables waiting;                                 ///< where `is_new`, else replaced; under mutex_
    std::array<bool, remap::kMaxSources> is_new{};  ///< under mutex_
    Tables in_use;                                  ///< the pipeline's
  };

  template <class Change>
  CommandResult request(std::size_t view, std::size_t source, const Change& change);
  void make(Slot& slot, std::size_t source);

  const std::vector<remap::ColourMap::Table> maps_;
  std::mutex requesting_;     ///< held while tables are made: each request changes the one before
  hal::PriorityMutex mutex_;  ///< the frame path locks it: never held across work
  std::vector<Slot> slots_;
};

}  // namespace orbwatch::app::pipeline
