// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/model/sink/view.h"
#include "app/pipeline/views/view_plan.h"
#include "hal/frame/buffer_pool.h"

namespace orbwatch::app::pipeline {

/// Bytes of a buffer that become resident: of a display view its picture, of up to three bytes per
/// pixel, and its validity; of a measured view the words that are measured in, too.
constexpr std::uint64_t display_bytes(int width, int height) {
  return std::uint64_t{4} * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}
constexpr std::uint64_t measured_bytes(int width, int height) {
  return display_bytes(width, height) / 4 * 6;
}

/// A buffer for any view of that size. What it is not used for never becomes resident.
View make_view(int width, int height);
/// Makes a view of the plan's size the plan's: with planes for what is measured, without a picture.
void set_plan(View& view, const ViewPlan& plan);
/// Gives a view that does not measure a plane for counts of temperature.
void add_counts(View& view);
/// Gives a view a picture in a format of up to three bytes per pixel, or none.
void set_format(View& view, std::optional<PixelFormat> format);

/// The buffers of all views: a pool per size, which display views and the measured ones of every
/// recipe share. Each has as many as can be in use at once: those that are rendered together (one
/// display view, or all that a recipe measures) and those that the sinks keep of the display views,
/// of a recipe, and of the recipe before. Whatever sinks keep, a measured view has a buffer.
/// Thread-bound: the pipeline's thread; loans are returned on any.
class ViewBuffers {
 public:
  using Views = std::span<const ViewPlan>;

  /// `kept`: by all sinks together.
  ViewBuffers(Views displays, const std::vector<Views>& recipes, const KeptViews& kept);

  /// One to render the view into, for the sinks, too; null: they hold every one. Does not allocate.
  std::shared_ptr<View> acquire(const ViewPlan& plan);
  /// One that no sink gets: as many as a recipe measures views of that size. Does not allocate.
  std::shared_ptr<View> acquire_unshared(const ViewPlan& plan);

  /// Number of buffers of one size that sinks get.
  std::size_t count(int width, int height) const;

 private:
  struct Pool {
    int width;
    int height;
    hal::BufferPool<View> shared;
    hal::BufferPool<View> unshared;
  };

  void add(const ViewPlan& view, Views displays, const std::vector<Views>& recipes,
           const KeptViews& kept);
  Pool& pool_of(const ViewPlan& plan);
  std::shared_ptr<View> prepared(std::shared_ptr<View> view, const ViewPlan& plan) const;

  std::vector<Pool> pools_;
  std::vector<std::string> names_;  ///< by View::index; recipes may be compiled anew
};

}  // namespace orbwatch::app::pipeline
