// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "app/model/sink/view.h"
#include "app/model/status/status.h"

namespace orbwatch::app::web {

/// The newest views into which clients point, by the number under which their picture was sent, so
/// that a pixel's values belong to the displayed picture. Views are held, not copied: at most kMost
/// in total, and none for longer than a client points. Thread-safe; wants() takes no lock.
class RecentViews {
 public:
  static constexpr std::size_t kMost = 8;
  /// Time for which a request counts as pointing; a user moves the pointer, reads, and moves it
  /// again.
  static constexpr std::chrono::seconds kPointing{5};

  /// Reports that a client points into a view; its views are kept from now on.
  void point(std::size_t view, hal::TimePoint now);
  bool wants(std::size_t view, hal::TimePoint now) const;

  /// Keeps a view in place of the oldest one.
  void keep(ViewPtr view, std::uint64_t number);
  /// The view sent under this number; null: not kept, or no longer kept.
  ViewPtr find(std::size_t view, std::uint64_t number) const;

  /// Releases the views into which clients no longer point.
  void release_unwanted(hal::TimePoint now);
  void release_all();

 private:
  struct Kept {
    ViewPtr view;
    std::uint64_t number = 0;
  };

  template <class Is>
  void release_if(const Is& is);

  std::array<std::atomic<hal::TimePoint>, kMaxViews> pointed_until_{};
  mutable std::mutex mutex_;
  std::array<Kept, kMost> kept_;  ///< under mutex_
  std::size_t oldest_ = 0;        ///< under mutex_
};

}  // namespace orbwatch::app::web
