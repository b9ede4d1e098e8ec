#include "app/pipeline/pan_tilt_zoom.h"

#include <cmath>
#include <string>
#include <utility>

namespace orbwatch::app {
namespace {

Result<optics::ViewProjection> pointed(const ViewPlan& view, const Pointing& pointing) {
  const optics::ViewSpec spec{view.projection.kind(),  pointing.orientation,
                              pointing.h_fov,          pointing.v_fov,
                              view.projection.width(), view.projection.height()};
  if (spec.kind != optics::ViewKind::Ball) return optics::ViewProjection::make(spec);
  return optics::check_view(spec).map([&] { return view.projection; });
}

}  // namespace

PanTiltZoom::PanTiltZoom(std::span<const ViewPlan> views) : views_(views), slots_(views.size()) {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const optics::ViewSpec& spec = views_[i].projection.spec();
    slots_[i].aim.pointing = {spec.orientation, spec.h_fov, spec.v_fov};
    for (const ViewSource& source : views_[i].sources) {
      slots_[i].aim.weights.push_back(source.weight);
    }
  }
  thread_ = std::thread([this] { run(); });
}

PanTiltZoom::~PanTiltZoom() { stop(); }

/// `change` makes the aim that is asked for of the one asked for last.
template <class Change>
Result<std::uint64_t> PanTiltZoom::ask(std::size_t view, const Change& change) {
  if (view >= views_.size()) {
    return fail("view " + std::to_string(view) + ": is none that can be pointed; there are " +
                std::to_string(views_.size()) + ", from 0");
  }
  const auto refused = [&](const std::string& reason) {
    return fail("view " + views_[view].name + ": " + reason);
  };
  const std::lock_guard one_at_a_time(asking_);
  Slot& slot = slots_[view];
  Aim aim = slot.aim;
  if (const auto done = change(aim); !done) return refused(done.error().message);
  const auto projection = pointed(views_[view], aim.pointing);
  if (!projection) return refused(projection.error().message);
  Request request{*projection, aim.weights, slot.requests + 1};
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return refused("cannot be pointed any more; the pipeline has stopped");
    slot.superseded += slot.request ? 1 : 0;
    slot.request = std::move(request);
  }
  slot.aim = std::move(aim);
  work_.notify_one();
  return ++slot.requests;
}

Result<std::uint64_t> PanTiltZoom::point(std::size_t view, const Pointing& pointing) {
  return ask(view, [&](Aim& aim) -> Result<> {
    aim.pointing = pointing;
    return {};
  });
}

Result<std::uint64_t> PanTiltZoom::turn(std::size_t view, double yaw, double pitch, double h_fov) {
  return ask(view, [&](Aim& aim) -> Result<> {
    aim.pointing.orientation.yaw = yaw;
    aim.pointing.orientation.pitch = pitch;
    if (h_fov > 0) aim.pointing = {aim.pointing.orientation, h_fov, {}};
    return {};
  });
}

Result<std::uint64_t> PanTiltZoom::mix(std::size_t view, std::size_t source, double weight) {
  return ask(view, [&](Aim& aim) -> Result<> {
    if (source >= aim.weights.size()) {
      return fail("has no source " + std::to_string(source) + "; it has " +
                  std::to_string(aim.weights.size()) + ", from 0");
    }
    if (!(weight > 0) || !std::isfinite(weight)) return fail("a weight must be above 0");
    aim.weights[source] = weight;
    return {};
  });
}

void PanTiltZoom::exchange(std::span<PointedRenderer> shown) {
  bool replaced = false;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t view = 0; view < slots_.size(); ++view) {
      if (!std::exchange(slots_[view].compiled, false)) continue;
      std::swap(slots_[view].renderer, shown[view]);
      replaced = true;
    }
  }
  if (replaced) work_.notify_one();
}

std::uint64_t PanTiltZoom::superseded(std::size_t view) const {
  const std::lock_guard lock(mutex_);
  return slots_[view].superseded;
}

void PanTiltZoom::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void PanTiltZoom::run() {
  std::size_t view = 0;
  while (const auto work = take_work(view)) {
    view = work->view;
    if (work->request) compile(view, *work->request);
  }
}

std::optional<PanTiltZoom::Work> PanTiltZoom::take_work(std::size_t last) {
  PointedRenderer unused;  // freed after the lock
  std::size_t view = last;
  const auto any_work = [&] {
    // In turns: a view that is pointed all the time does not keep the others waiting.
    for (std::size_t n = 1; n <= slots_.size(); ++n) {
      view = (last + n) % slots_.size();
      const Slot& slot = slots_[view];
      if (slot.request || (slot.renderer.renderer && !slot.compiled)) return true;
    }
    return false;
  };
  std::unique_lock lock(mutex_);
  work_.wait(lock, [&] { return stopping_ || any_work(); });
  if (stopping_) return std::nullopt;
  Slot& slot = slots_[view];
  if (!slot.compiled) std::swap(slot.renderer, unused);
  return Work{view, std::exchange(slot.request, std::nullopt)};
}

void PanTiltZoom::compile(std::size_t view, const Request& request) {
  ViewPlan plan = views_[view];
  plan.projection = request.projection;
  for (std::size_t i = 0; i < plan.sources.size(); ++i) {
    plan.sources[i].weight = request.weights[i];
  }
  // In the end what it replaced, freed after the lock.
  PointedRenderer renderer{std::make_unique<ViewRenderer>(std::move(plan)), request.number};
  const std::lock_guard lock(mutex_);
  Slot& slot = slots_[view];
  slot.superseded += slot.compiled ? 1 : 0;
  slot.compiled = true;
  std::swap(slot.renderer, renderer);
}

}  // namespace orbwatch::app
