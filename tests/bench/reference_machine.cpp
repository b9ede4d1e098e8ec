// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference_machine.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "app/pipeline/views/view_settings.h"
#include "tests/bench/ball_in_picture.h"

namespace orbwatch::bench {
namespace {

constexpr std::size_t kColour = 0, kThermal = 1;               // cameras
constexpr std::size_t kPanorama = 0, kDoor = 1, kProcess = 2;  // views; those of recipes are last
constexpr std::size_t kViews = 3;
constexpr double kThermalYaw = 180;
constexpr double kKelvinPerCount = 0.04;
constexpr double kRate = 30;

/// A frame set under emulation takes longer than the product allows.
constexpr std::chrono::seconds kPatience{300};

hal::StreamFormat colour_format() { return {PixelFormat::Nv12, {}, 1920, 1080, kRate}; }
hal::StreamFormat thermal_format() { return {PixelFormat::Y16, {}, 640, 512, kRate}; }
optics::BallProjection colour_ball() { return ball_in_picture(1920, 1080, 0); }
optics::BallProjection thermal_ball() { return ball_in_picture(640, 512, kThermalYaw); }

/// Counts of a black body at `celsius`.
double counts(double celsius) { return (celsius + 273.15) / kKelvinPerCount; }

app::pipeline::ViewSource colour_source() {
  return {kColour, colour_format(), colour_ball(), 1, {ramp(), 0, 255}, app::pipeline::kSharpness};
}
app::pipeline::ViewSource thermal_source() {
  return {kThermal,
          thermal_format(),
          thermal_ball(),
          0.6,
          {ramp(), counts(20), counts(800)},
          app::pipeline::kSharpness};
}

app::pipeline::ViewPlan view(std::size_t index, const optics::ViewSpec& spec,
                             std::vector<app::pipeline::ViewSource> sources) {
  return {index,
          "",
          optics::ViewProjection::make(spec).value(),
          std::move(sources),
          app::pipeline::Combine::Mix,
          remap::Interpolation::Area,
          std::nullopt};
}

app::pipeline::ViewPlan process_view() {
  const optics::YawPitchRoll at_the_table{kThermalYaw / 2, -30, 0};
  auto plan = view(kProcess, {optics::ViewKind::Perspective, at_the_table, 90, {}, 1920, 1080},
                   {colour_source(), thermal_source()});
  plan.measured = kThermal;
  return plan;
}

std::vector<app::pipeline::ViewPlan> display_views() {
  const optics::ViewSpec panorama{optics::ViewKind::Equirectangular, {}, {}, {}, 1024, 512};
  const optics::ViewSpec door{optics::ViewKind::Perspective, {0, -10, 0}, 90, {}, 640, 480};
  return {view(kPanorama, panorama, {colour_source(), thermal_source()}),
          view(kDoor, door, {colour_source()})};
}

/// A table 300 mm below a ball of 50 mm.
signals::RegionScene table() {
  optics::Scene scene;
  scene.room = optics::Scene::Room::Plane;
  scene.point = {0, 0, -300};
  scene.normal = {0, 0, 1};
  const optics::Ball ball{{}, 50};
  return {ball, optics::SceneProxy::make(scene, ball).value()};
}

/// The middle quarter of the view, with every signal.
app::pipeline::RegionPlan region_of(const optics::ViewProjection& view) {
  app::pipeline::RegionPlan region{"pool", 0, {}};
  for (const auto& [x, y] : {std::pair{480, 270}, {1440, 270}, {1440, 810}, {480, 810}}) {
    region.settings.outline.push_back(*view.direction(x, y));
  }
  region.settings.hot_spot_threshold = counts(1400);
  region.settings.plume_threshold = counts(600);
  region.settings.spatter_threshold = counts(700);
  region.settings.width_set_point = 20;
  region.settings.radiometry.kelvin_per_count = kKelvinPerCount;
  return region;
}

std::unique_ptr<app::pipeline::CompiledRecipe> recipe() {
  app::pipeline::RecipePlan plan;
  plan.number = 1;
  plan.views.push_back(process_view());
  plan.regions.push_back(region_of(plan.views[0].projection));
  signals::AlarmLimits width;
  width.signal = *find_word(signals::kSignalWords, "hot_spot_width");
  width.low_warning = 14;
  width.high_warning = 26;
  plan.alarms.push_back(width);
  return app::pipeline::CompiledRecipe::make(std::move(plan), table()).value();
}

/// Paints white noise.
void paint_colour(const MutablePicture& picture, unsigned seed) {
  std::uint32_t random = seed + 1;
  const std::size_t size = picture_bytes(
      picture.format, static_cast<std::size_t>(picture.planes[0].stride), picture.height);
  for (std::size_t i = 0; i < size; ++i) {
    random = random * 1664525 + 1013904223;
    picture.planes[0].data[i] = static_cast<std::byte>(random >> 24);
  }
}

/// Paints a molten pool on a cold table.
void paint_thermal(const MutablePicture& picture, unsigned seed) {
  constexpr double kRadius = 4;  // px
  const optics::ViewProjection view = process_view().projection;
  const auto centre =
      thermal_ball().pixel(*view.direction(view.width() / 2.0, view.height() / 2.0)).value();
  std::uint32_t random = seed + 1;
  const ImageView<std::uint16_t> samples = picture.samples<std::uint16_t>();
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      random = random * 1664525 + 1013904223;
      const double dx = x - centre.u, dy = y - centre.v;
      const bool is_pool = dx * dx + dy * dy < kRadius * kRadius;
      *samples.at(x, y) = static_cast<std::uint16_t>(counts(is_pool ? 1700 : 20) + (random >> 25));
    }
  }
}

std::unique_ptr<PreparedCamera> camera(const char* name, const hal::StreamFormat& format,
                                       const PreparedCamera::Paint& paint) {
  auto made = std::make_unique<PreparedCamera>(name, format, paint);
  made->configure({}).value();
  return made;
}

}  // namespace

/// Requires the data that the readers of the machine's views require.
class ReferenceMachine::Reader : public app::Sink {
 public:
  Reader(ReadAs read_as, std::function<void()> on_set)
      : read_as_(read_as), on_set_(std::move(on_set)) {}

  Result<> start() override { return {}; }
  void stop() override {}
  void accept_frames(const hal::FrameSet& set) override {
    is_whole_ = set.matched;
    views_ = 0;
    on_set_();
  }
  app::PictureNeeds needs(std::size_t view, hal::TimePoint) override {
    app::PictureNeeds needs;
    const bool is_jpeg = read_as_ == ReadAs::Jpeg || view == kDoor;
    (is_jpeg ? needs.jpeg : needs.rgb) = true;
    return needs;
  }
  void accept(const app::Status& status) override {
    if (views_ == 0) is_whole_ = is_whole_ && status.regions[0].signals.hot_spot_present > 0;
  }
  /// The pictures of a set follow its status.
  void accept(const app::ViewPtr& view) override {
    if (++views_ < kViews) return;
    const std::lock_guard lock(mutex_);
    if (is_whole_) shown_set_ = view->frame_set;
    changed_.notify_all();
  }

  /// True if set `number` ended, with a hot spot and every view.
  bool wait_for(std::uint64_t number) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return shown_set_ >= number; });
  }

 private:
  const ReadAs read_as_;
  const std::function<void()> on_set_;
  std::size_t views_ = 0;  ///< number in the set; this and the next are the pipeline thread's
  bool is_whole_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t shown_set_ = 0;
};

ReferenceMachine::ReferenceMachine(ReadAs read_as, std::function<void()> on_set)
    : reader_(std::make_unique<Reader>(read_as, std::move(on_set))) {
  auto colour = camera("colour", colour_format(), paint_colour);
  auto thermal = camera("thermal", thermal_format(), paint_thermal);
  colour_ = colour.get();
  thermal_ = thermal.get();
  app::pipeline::PipelinePlan plan;
  plan.cameras.push_back(std::move(colour));
  plan.cameras.push_back(std::move(thermal));
  plan.formats = {colour_format(), thermal_format()};
  plan.views = display_views();
  plan.recipes.push_back(recipe());
  plan.view_count = kViews;
  plan.workers = 0;
  plan.deadline = kPatience;
  plan.sync.max_wait = kPatience;
  pipeline_.emplace(std::move(plan));
  if (auto started = pipeline_->start({reader_.get()}); !started) {
    throw std::runtime_error(started.error().message);
  }
}

ReferenceMachine::~ReferenceMachine() { pipeline_->stop(); }

bool ReferenceMachine::run() {
  // Exposures are as regular as a camera's: else the next frame would be expected at another time.
  const auto moment = begin_ + sets_ * hal::period_of(kRate);
  colour_->expose(moment);
  thermal_->expose(moment);
  return reader_->wait_for(++sets_);
}

}  // namespace orbwatch::bench
