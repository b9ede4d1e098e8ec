#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "app/model/status.h"
#include "app/model/view.h"

namespace orbwatch::app::web {

/// The newest views into which somebody points, by the number under which their picture was sent,
/// so that what is said of a pixel is of the picture that is seen. Views are kept, not copied: at
/// most kMost of all together, and none for longer than somebody points.
/// Thread-safe; wants() takes no lock.
class RecentViews {
 public:
  static constexpr std::size_t kMost = 8;
  /// A person moves the pointer, reads, and moves it again.
  static constexpr std::chrono::seconds kPointing{5};

  /// Somebody points into a view: from now on its views are kept.
  void point(std::size_t view, hal::TimePoint now);
  bool wants(std::size_t view, hal::TimePoint now) const;

  /// Keeps a view in place of the oldest.
  void keep(ViewPtr view, std::uint64_t number);
  /// Null: it is not kept, or not any more.
  ViewPtr find(std::size_t view, std::uint64_t number) const;

  /// Releases the views into which nobody points any more.
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
