// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/camera_group.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/log.h"

namespace orbwatch::app::pipeline {
namespace {

/// Longest time that any camera needs to apply a control that it accepts.
constexpr std::chrono::seconds kControlPatience{2};

bool is_as_configured(const Picture& picture, const hal::StreamFormat& format) {
  return picture.format == format.format && picture.width == format.width &&
         picture.height == format.height;
}

/// Passes the frames that belong to a trigger and numbers them; the trigger of a withheld frame is
/// missed.
hal::Camera::Gate stamp_with(const std::shared_ptr<hal::FrameTrigger>& trigger) {
  return [trigger](hal::FrameMetadata& metadata) {
    if (metadata.status == hal::FrameStatus::Withheld) {
      return trigger->miss(metadata.exposure_start);
    }
    const auto stamp = trigger->claim(metadata.exposure_start);
    if (stamp) metadata.trigger = stamp->id;
    return stamp.has_value();
  };
}

}  // namespace

CameraGroup::CameraGroup(Cameras cameras, const Names& names, const Formats& formats,
                         const CameraSet& absent, const Triggers& triggers,
                         const hal::SyncSettings& sync)
    : sync_(cameras.size(), sync), members_(cameras.size()) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    member.camera = std::move(cameras[i]);
    member.name = i < names.size() ? names[i] : member.camera->info().id;
    member.format = formats[i];
    if (i < triggers.size()) member.trigger = triggers[i];
    if (member.trigger) member.camera->set_gate(stamp_with(member.trigger));
    if (member.trigger || members_.size() > 1) member.camera->require_stamps();
    member.camera->set_on_notice([&member](const std::string& text) {
      log_soon(LogLevel::Info, {member.camera->info().id, ": ", text}, {.camera = member.name});
    });
    member.absent = absent[i];
    if (member.absent) miss(i, hal::Fault::Unplugged);
  }
}

Result<> CameraGroup::start() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].absent) continue;
    if (auto started = start(i); !started) return started;
  }
  return {};
}

Result<> CameraGroup::start(std::size_t index) {
  return members_[index].camera->start(
      [this, index](hal::Frame frame) { on_frame(index, std::move(frame)); },
      [this, index](const hal::FaultReport& report) { on_fault(index, report); });
}

void CameraGroup::stop() {
  for (Member& member : members_) member.camera->stop();
}

std::size_t CameraGroup::faulty() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      members_, [](const Member& member) { return member.fault != hal::Fault::None; }));
}

std::size_t CameraGroup::late() const {
  std::size_t late = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) late += sync_.is_late(i) ? 1 : 0;
  return late;
}

std::size_t CameraGroup::pacing_camera() const {
  std::size_t first = members_.size();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].fault != hal::Fault::None) continue;
    if (!sync_.is_late(i)) return i;
    first = std::min(first, i);
  }
  return first == members_.size() ? 0 : first;
}

std::chrono::nanoseconds CameraGroup::capture_time() const {
  std::chrono::nanoseconds time{0};
  for (const Member& member : members_) time += member.camera->capture_time();
  return time;
}

void CameraGroup::miss(std::size_t camera, hal::Fault fault) {
  members_[camera].fault = fault;
  abandon(camera);
}

/// Drops the waiting frames of a camera that does not deliver, and counts its triggers as missed.
void CameraGroup::abandon(std::size_t camera) {
  sync_.clear(camera);
  if (const auto& trigger = members_[camera].trigger) trigger->abandon();
}

Result<> CameraGroup::admit(std::size_t camera, const hal::StreamFormat& format) {
  const std::lock_guard lock(setting_);
  if (auto done = set(camera); !done) return done;
  Member& member = members_[camera];
  const auto scale = member.camera->count_scale();
  if (scale && format.kelvin_per_count > 0 && scale->kelvin_per_count != format.kelvin_per_count) {
    return fail("the recipe's controls change what a count means: " + scale->stated_by);
  }
  member.format = format;
  abandon(camera);
  auto started = start(camera);
  member.absent = !started;
  return started;
}

Result<> CameraGroup::apply(std::uint16_t recipe, const std::vector<CameraControl>& controls) {
  const std::lock_guard lock(setting_);
  controls_ = controls;
  Result<> result;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].absent) continue;
    const auto done = set(i);
    if (done || !result) continue;
    result = fail("recipe " + std::to_string(recipe) + ": camera " + members_[i].camera->info().id +
                  ": " + done.error().message);
  }
  return result;
}

/// Sets the controls of one camera; returns the first error.
Result<> CameraGroup::set(std::size_t index) {
  Result<> result;
  for (const CameraControl& control : controls_) {
    if (control.camera.index != index) continue;
    auto done = members_[index].camera->set(control.name, control.value);
    if (result) result = std::move(done);
  }
  return result;
}

void CameraGroup::on_frame(std::size_t index, hal::Frame frame) {
  Member& member = members_[index];
  if (!is_as_configured(frame->picture, member.format)) {
    on_fault(index, {hal::Fault::WrongFormat, {}});
    return;
  }
  if (member.fault != hal::Fault::None) on_fault(index, {});
  watch_controls(member, frame->metadata);
  const auto now = hal::Clock::now();
  {
    const std::lock_guard lock(member.metering);
    member.meter.add(now - frame->metadata.exposure_start);
  }
  member.last_frame = now;
  sync_.put(index, std::move(frame));
}

/// Logs once that a camera deviates from its settings; regions that need the setting are not
/// measured.
void CameraGroup::watch_controls(Member& member, const hal::FrameMetadata& metadata) {
  const bool is_overdue =
      metadata.not_as_set && metadata.exposure_start - metadata.controls_as_of > kControlPatience;
  if (is_overdue && !member.is_otherwise) {
    log_soon(LogLevel::Warning,
             {member.camera->info().id, ": its ", metadata.not_as_set,
              " differs from its setting; set a value that the camera supports"},
             {.camera = member.name, .trigger = metadata.trigger.value_or(0)});
  }
  member.is_otherwise = is_overdue;
}

void CameraGroup::on_fault(std::size_t index, const hal::FaultReport& report) {
  Member& member = members_[index];
  const hal::Fault before = member.fault.exchange(report.fault);
  if (before == report.fault) return;
  const bool is_cleared = report.fault == hal::Fault::None;
  if (!is_cleared) abandon(index);
  const bool has_detail = !report.detail.empty();
  log_soon(is_cleared ? LogLevel::Info : LogLevel::Warning,
           {member.camera->info().id, ": ", operator_text(report.fault), has_detail ? " (" : "",
            report.detail, has_detail ? ")" : ""},
           {.camera = member.name,
            .fault = hal::word(is_cleared ? before : report.fault),
            .trigger = member.trigger ? member.trigger->counts().triggers : 0});
}

void CameraGroup::report(Status& status, std::optional<hal::Clock::duration> elapsed) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    CameraStatus& camera = status.cameras[i];
    const hal::FrameCounts counts = sync_.counts(i);
    const hal::FrameQuality quality = member.camera->quality();
    camera.fault = member.fault;
    camera.frames = counts.frames;
    camera.lost = counts.lost;
    camera.dropped = counts.dropped();
    camera.unmatched = counts.unmatched;
    camera.damaged = quality.damaged;
    camera.flawed = quality.flawed;
    const hal::LinkCounts link = member.camera->link_counts();
    camera.missing_packets = link.missing_packets;
    camera.resent_packets = link.resent_packets;
    camera.underruns = link.underruns;
    camera.last_frame = member.last_frame;
    if (member.trigger) {
      const hal::TriggerCounts triggers = member.trigger->counts();
      camera.triggers = triggers.triggers;
      camera.missed = triggers.missed;
    }
    if (elapsed) {
      const std::lock_guard lock(member.metering);
      member.meter.roll(*elapsed, camera);
    }
  }
}

}  // namespace orbwatch::app::pipeline
