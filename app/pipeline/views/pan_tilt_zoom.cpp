// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/pan_tilt_zoom.h"

#include <cmath>
#include <string>
#include <utility>

namespace orbwatch::app::pipeline {
namespace {

Result<optics::ViewProjection> pointed(const ViewPlan& view, const Pointing& pointing) {
  const optics::ViewSpec spec{view.projection.kind(),  pointing.orientation,
                              pointing.h_fov,          pointing.v_fov,
                              view.projection.width(), view.projection.height()};
  if (spec.kind != optics::ViewKind::Ball) return optics::ViewProjection::make(spec);
  return optics::check_view(spec).map([&] { return view.projection; });
}

}  // namespace

PanTiltZoom::PanTiltZoom(std::span<const ViewPlan> views, Threads threads)
    : views_(views),
      slots_(views.size()),
      compiler_(std::move(threads), [this] { compile_all(); }) {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const optics::ViewSpec& spec = views_[i].projection.spec();
    slots_[i].aim = {{spec.orientation, spec.h_fov, spec.v_fov}, views_[i].sources};
  }
}

PanTiltZoom::~PanTiltZoom() { stop(); }

/// `change` turns the aim of the newest request into that of this one.
template <class Change>
Result<std::uint64_t> PanTiltZoom::request(std::size_t view, const Change& change) {
  if (view >= views_.size()) {
    return fail("view " + std::to_string(view) + ": cannot be pointed; there are " +
                std::to_string(views_.size()) + ", from 0");
  }
  const auto refused = [&](const std::string& reason) {
    return fail("view " + views_[view].name + ": " + reason);
  };
  const std::lock_guard one_at_a_time(requesting_);
  Slot& slot = slots_[view];
  Aim aim = slot.aim;
  if (const auto done = change(aim); !done) return refused(done.error().message);
  const auto projection = pointed(views_[view], aim.pointing);
  if (!projection) return refused(projection.error().message);
  Request request{*projection, aim.sources, slot.requests + 1};
  {
    const std::lock_guard lock(mutex_);
    if (stopped_) return refused("cannot be pointed any more; the pipeline has stopped");
    slot.superseded += slot.request ? 1 : 0;
    slot.request = std::move(request);
  }
  slot.aim = std::move(aim);
  compiler_.request();
  return ++slot.requests;
}

Result<std::uint64_t> PanTiltZoom::point(std::size_t view, const Pointing& pointing) {
  return request(view, [&](Aim& aim) -> Result<> {
    aim.pointing = pointing;
    return {};
  });
}

Result<std::uint64_t> PanTiltZoom::turn(std::size_t view, double yaw, double pitch, double h_fov) {
  return request(view, [&](Aim& aim) -> Result<> {
    aim.pointing.orientation.yaw = yaw;
    aim.pointing.orientation.pitch = pitch;
    if (h_fov > 0) aim.pointing = {aim.pointing.orientation, h_fov, {}};
    return {};
  });
}

Result<std::uint64_t> PanTiltZoom::mix(std::size_t view, std::size_t source, double weight) {
  return request(view, [&](Aim& aim) -> Result<> {
    if (source >= aim.sources.size()) {
      return fail("has no source " + std::to_string(source) + "; it has " +
                  std::to_string(aim.sources.size()) + ", from 0");
    }
    if (!(weight > 0) || !std::isfinite(weight)) return fail("a weight must be above 0");
    aim.sources[source].weight = weight;
    return {};
  });
}

Result<> PanTiltZoom::adopt(std::size_t view, std::vector<ViewSource> sources) {
  const auto requested = request(view, [&](Aim& aim) -> Result<> {
    for (std::size_t i = 0; i < sources.size(); ++i) sources[i].weight = aim.sources[i].weight;
    aim.sources = std::move(sources);
    return {};
  });
  return requested.map([](std::uint64_t) {});
}

void PanTiltZoom::exchange(std::size_t view, std::unique_ptr<ViewRenderer>& in_use) {
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(slots_[view].compiled, false)) return;
    std::swap(slots_[view].renderer, in_use);
  }
  compiler_.request();
}

std::uint64_t PanTiltZoom::superseded(std::size_t view) const {
  const std::lock_guard lock(mutex_);
  return slots_[view].superseded;
}

void PanTiltZoom::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  compiler_.cancel();
}

void PanTiltZoom::compile_all() {
  while (const auto work = next_work(last_)) {
    last_ = work->view;
    if (work->request) compile(last_, *work->request);
  }
}

/// Frees a replaced renderer and returns the request to be compiled, in turns: a view that is
/// pointed all the time does not keep the others waiting. nullopt: nothing to do, or stopped.
std::optional<PanTiltZoom::Work> PanTiltZoom::next_work(std::size_t last) {
  std::unique_ptr<ViewRenderer> replaced;  // freed after the lock
  const std::lock_guard lock(mutex_);
  if (stopped_) return std::nullopt;
  for (std::size_t n = 1; n <= slots_.size(); ++n) {
    const std::size_t view = (last + n) % slots_.size();
    Slot& slot = slots_[view];
    if (!slot.compiled) std::swap(slot.renderer, replaced);
    if (slot.request || replaced) return Work{view, std::exchange(slot.request, std::nullopt)};
  }
  return std::nullopt;
}

void PanTiltZoom::compile(std::size_t view, const Request& request) {
  ViewPlan plan = views_[view];
  plan.projection = request.projection;
  plan.sources = request.sources;
  plan.pointing = request.number;
  // Holds the superseded one at the end, which is freed after the lock.
  auto renderer = std::make_unique<ViewRenderer>(std::move(plan));
  const std::lock_guard lock(mutex_);
  Slot& slot = slots_[view];
  slot.superseded += slot.compiled ? 1 : 0;
  slot.compiled = true;
  std::swap(slot.renderer, renderer);
}

}  // namespace orbwatch::app::pipeline
