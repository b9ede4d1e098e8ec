// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/daemon/appliance.h"
#include "app/daemon/site/published.h"
#include "app/daemon/site/recorded_cameras.h"
#include "app/ports/recorder/messages.h"
#include "hal/recording/recorded_clock.h"
#include "tests/app/daemon/demo_site.h"
#include "tests/app/daemon/replay/jpeg_topics.h"
#include "tests/hal/recording/picture_file.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// The demo, run by the product's own pipeline, and what it measured: states of the process and
/// pictures of the camera that measures.
class RecordedDemo {
 public:
  static constexpr std::size_t kThermal = app::daemon::kThermalCamera;
  /// The ball in the thermal picture, 116 px around the middle, with what is interpolated.
  static constexpr hal::recording::PictureRegion kBall{40, 8, 240, 240};

  /// Runs until `sets` frame sets were measured by the thermal camera.
  explicit RecordedDemo(std::size_t sets) : RecordedDemo(sets, app::daemon::demo(), kThermal) {}

  /// The same for a site of the demo's cameras that measures by this one.
  RecordedDemo(std::size_t sets, app::files::Resolved site, std::size_t camera)
      : camera_(camera), site_(std::move(site)), texts_(app::daemon::recorded_texts(site_, {})) {
    site_.state_folder = state_.path();
    std::get<app::ConsoleSettings>(site_.site.sinks).enabled = false;
    std::get<app::ModbusSettings>(site_.site.sinks).enabled = false;
    std::get<app::DdsSettings>(site_.site.sinks).enabled = false;
    std::get<app::WebSettings>(site_.site.sinks).enabled = false;
    Keeper keeper(*this, sets);  // outlives the appliance
    auto made =
        app::daemon::Appliance::make(site_, {[] { return Result<>(); }, [] {}},
                                     [](const app::CalibrationEntry&) { return Result<>(); });
    if (!made) throw std::runtime_error(made.error().message);
    if (const auto started = (*made)->start({&keeper}); !started) {
      throw std::runtime_error(started.error().message);
    }
    keeper.wait();
    format_ = (*made)->formats()[camera_];
    ball_ = camera_ == kThermal
                ? kBall
                : app::daemon::recorded_cameras(site_, (*made)->formats())[camera_].ball;
    ball_ = hal::recording::widened(ball_, format_.format);
    made->reset();
    if (sets_.back().state.frame_set == 0) sets_.pop_back();  // not measured before the end
  }

  /// Files of the configuration in recordings.
  app::RecordedTexts& texts() { return texts_; }

  /// Writes all of it; or, with `has_pictures` false, without pictures; or as JPEG of a quality.
  void write(const std::filesystem::path& path, bool has_pictures = true,
             std::optional<int> quality = {}) const {
    PictureFile file(path);
    file.add(clock_.metadata());
    for (const auto& [name, text] : texts_.files) file.attach(name, text);
    const std::string& name = site_.names.cameras[camera_];
    if (quality) {
      JpegTopics topics(file, name, format_, *quality);
      write_sets(file, topics, has_pictures);
    } else {
      CameraTopics topics(file, name, format_);
      write_sets(file, topics, has_pictures);
    }
    file.finish();
  }

  /// Adds to every count of the thermal pictures.
  void brighten(int counts) {
    for (Set& set : sets_) {
      for (std::size_t k = 0; k < set.pixels.size(); k += 2) {
        std::uint16_t count = 0;
        std::memcpy(&count, &set.pixels[k], sizeof count);
        count = static_cast<std::uint16_t>(count + counts);
        std::memcpy(&set.pixels[k], &count, sizeof count);
      }
    }
  }

  std::size_t pictures() const {
    std::size_t count = 0;
    for (const Set& set : sets_) count += set.pixels.empty() ? 0 : 1;
    return count;
  }

 private:
  struct Set {
    hal::TimePoint stamp, computed;
    hal::FrameMetadata metadata;
    std::vector<std::byte> pixels;  ///< empty: the camera has no new picture in the set
    app::recorder::ProcessState state;
  };

  /// Keeps what the pipeline passes to sinks.
  class Keeper : public app::Sink {
   public:
    Keeper(RecordedDemo& demo, std::size_t sets) : demo_(demo), count_(sets) {}
    Result<> start() override { return {}; }
    void stop() override {}
    void accept(const app::ViewPtr&) override {}

    void accept_frames(const hal::FrameSet& set) override {
      Set& kept = demo_.sets_.emplace_back();
      kept.stamp = set.stamp;
      const hal::Frame& frame = set.frames[demo_.camera_];
      if (!frame || set.held[demo_.camera_]) return;
      kept.metadata = frame->metadata;
      const Picture& picture = frame->picture;
      const int row = row_bytes(picture.format, picture.width);
      kept.pixels.resize(
          picture_bytes(picture.format, static_cast<std::size_t>(row), picture.height));
      const auto copy = MutablePicture::contiguous(picture.format, picture.width, picture.height,
                                                   kept.pixels.data(), row);
      hal::recording::copy_pixels(picture, copy);
    }
    void accept(const app::Status& status) override {
      if (status.frame_set == measured_ || demo_.sets_.empty()) return;
      measured_ = status.frame_set;
      Set& set = demo_.sets_.back();
      set.computed = hal::Clock::now();
      const std::chrono::system_clock::time_point utc{
          std::chrono::nanoseconds(demo_.clock_.to_utc(status.stamp))};
      set.state =
          app::recorder::process_state_of({status, demo_.site_.names, hal::Clock::now(), utc});
      const std::lock_guard lock(mutex_);
      if (++done_ == count_) changed_.notify_all();
    }
    /// Waits for the sets; the pipeline keeps more while it ends.
    void wait() {
      std::unique_lock lock(mutex_);
      if (!changed_.wait_for(lock, std::chrono::minutes(2), [&] { return done_ >= count_; })) {
        throw std::runtime_error("the demo measured too few frame sets");
      }
    }

   private:
    RecordedDemo& demo_;
    const std::size_t count_;
    std::uint64_t measured_ = 0;  ///< newest set; used by the pipeline's thread only
    std::mutex mutex_;            ///< guards done_
    std::condition_variable changed_;
    std::size_t done_ = 0;  ///< measured sets
  };

  template <class Topics>
  void write_sets(PictureFile& file, Topics& topics, bool has_pictures) const {
    const auto states = file.add("/orbwatch/process_state", hal::recording::SetNumbers::kType);
    for (const Set& set : sets_) {
      const std::uint64_t stamp = clock_.to_utc(set.stamp);
      if (has_pictures && !set.pixels.empty()) {
        topics.write(picture_at(set.pixels.data()), ball_, stamp,
                     clock_.to_utc(set.metadata.exposure_start),
                     static_cast<std::uint32_t>(set.metadata.sequence));
      }
      file.write(states, stamp, static_cast<std::uint32_t>(set.state.frame_set), set.state,
                 clock_.to_utc(set.computed));
      file.flush();
    }
  }

  Picture picture_at(const std::byte* pixels) const {
    Picture picture = Picture::contiguous(format_.format, format_.width, format_.height, pixels,
                                          row_bytes(format_.format, format_.width));
    picture.colour_space = format_.colour_space;
    return picture;
  }

  TemporaryFolder state_;
  const std::size_t camera_;
  app::files::Resolved site_;
  app::RecordedTexts texts_;
  hal::recording::RecordedClock clock_{1'700'000'000'000'000'000};
  hal::StreamFormat format_;
  hal::recording::PictureRegion ball_;
  std::vector<Set> sets_;
};

}  // namespace orbwatch::tests
