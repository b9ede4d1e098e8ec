// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_buffers.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {
namespace {

hal::BufferPool<View> make_pool(int width, int height, std::size_t count) {
  std::vector<std::unique_ptr<View>> buffers;
  for (std::size_t i = 0; i < count; ++i) {
    buffers.push_back(std::make_unique<View>(make_view(width, height)));
  }
  return hal::BufferPool<View>(std::move(buffers));
}

std::size_t count_of(ViewBuffers::Views views, int width, int height) {
  return static_cast<std::size_t>(std::ranges::count_if(views, [&](const ViewPlan& view) {
    return view.projection.width() == width && view.projection.height() == height;
  }));
}

/// How many views of one size there are.
struct Demand {
  std::size_t displayed = 0;
  std::size_t measured = 0;         ///< by the recipe with the most
  std::size_t measured_before = 0;  ///< by the one with the most of the others

  Demand(ViewBuffers::Views displays, const std::vector<ViewBuffers::Views>& recipes, int width,
         int height)
      : displayed(count_of(displays, width, height)) {
    for (const ViewBuffers::Views& recipe : recipes) {
      std::size_t count = count_of(recipe, width, height);
      if (count > measured) std::swap(count, measured);
      measured_before = std::max(measured_before, count);
    }
  }

  std::size_t buffers(const KeptViews& kept) const {
    const std::size_t rendered = std::max<std::size_t>(measured, displayed > 0 ? 1 : 0);
    return rendered + kept.of_each * (displayed + measured + measured_before) + kept.besides;
  }
};

ImageView<std::uint16_t> words_of(View& view) {
  const int width = view.validity.width;
  return {view.words.data(), width, view.validity.height, 1, width};
}

}  // namespace

View make_view(int width, int height) {
  const auto pixels = static_cast<std::size_t>(width) * height;
  View view;
  view.bytes.resize(4 * pixels);
  view.words.resize(pixels);
  view.validity = {view.bytes.data() + 3 * pixels, width, height, 1, width};
  return view;
}

void set_plan(View& view, const ViewPlan& plan) {
  view.index = plan.index;
  view.name = plan.name;
  view.picture = {};
  view.luminance = {};
  view.radiometric = {};
  view.counts = {};
  if (!plan.measured) return;
  const ViewSource& measured = plan.sources[*plan.measured];
  if (info(measured.format.format).bytes_per_sample() == 2) {
    view.radiometric = words_of(view);
    if (counts_temperature(measured)) view.counts = view.radiometric;
  } else {
    const int width = view.validity.width, height = view.validity.height;
    view.luminance = {reinterpret_cast<std::uint8_t*>(view.words.data()), width, height, 1, width};
  }
}

void add_counts(View& view) { view.counts = words_of(view); }

void set_format(View& view, std::optional<PixelFormat> format) {
  if (!format) {
    view.picture = {};
    return;
  }
  const int width = view.validity.width, height = view.validity.height;
  view.picture = MutablePicture::contiguous(*format, width, height,
                                            reinterpret_cast<std::byte*>(view.bytes.data()),
                                            row_bytes(*format, width));
  if (*format == PixelFormat::I420) view.picture.colour_space = remap::kJfif;
}

ViewBuffers::ViewBuffers(Views displays, const std::vector<Views>& recipes, const KeptViews& kept) {
  for (const ViewPlan& view : displays) add(view, displays, recipes, kept);
  for (const Views& recipe : recipes) {
    for (const ViewPlan& view : recipe) add(view, displays, recipes, kept);
  }
}

void ViewBuffers::add(const ViewPlan& view, Views displays, const std::vector<Views>& recipes,
                      const KeptViews& kept) {
  names_.resize(std::max(names_.size(), view.index + 1));
  names_[view.index] = view.name;
  const int width = view.projection.width(), height = view.projection.height();
  if (count(width, height) > 0) return;
  const Demand demand(displays, recipes, width, height);
  pools_.push_back({width, height, make_pool(width, height, demand.buffers(kept)),
                    make_pool(width, height, demand.measured)});
}

std::shared_ptr<View> ViewBuffers::acquire(const ViewPlan& plan) {
  return prepared(pool_of(plan).shared.acquire(), plan);
}

std::shared_ptr<View> ViewBuffers::acquire_unshared(const ViewPlan& plan) {
  return prepared(pool_of(plan).unshared.acquire(), plan);
}

std::size_t ViewBuffers::count(int width, int height) const {
  for (const Pool& pool : pools_) {
    if (pool.width == width && pool.height == height) return pool.shared.size();
  }
  return 0;
}

/// Views compiled anew keep their sizes.
ViewBuffers::Pool& ViewBuffers::pool_of(const ViewPlan& plan) {
  const auto pool = std::ranges::find_if(pools_, [&plan](const Pool& candidate) {
    return candidate.width == plan.projection.width() &&
           candidate.height == plan.projection.height();
  });
  assert(pool != pools_.end());
  return *pool;
}

std::shared_ptr<View> ViewBuffers::prepared(std::shared_ptr<View> view,
                                            const ViewPlan& plan) const {
  if (!view) return nullptr;
  set_plan(*view, plan);
  view->name = names_[plan.index];
  return view;
}

}  // namespace orbwatch::app::pipeline
