// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/camera_manager.h"

#include <libcamera/camera.h>
#include <libcamera/property_ids.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <utility>

namespace orbwatch::hal {
namespace {

/// The receivers of removals. Not libcamera's signal: disconnecting from it while it is emitted on
/// libcamera's thread is not safe.
struct RemovalWatches {
  std::mutex mutex;
  std::vector<const RemovalWatch*> watches;

  void notify(const libcamera::Camera* removed) {
    const std::lock_guard lock(mutex);
    for (const RemovalWatch* watch : watches) watch->notify(removed);
  }
};

struct TheManager {
  std::mutex mutex;
  std::condition_variable gone;
  bool exists = false;
  std::weak_ptr<libcamera::CameraManager> share;
  RemovalWatches watches;
};

TheManager& the_manager() {
  static TheManager manager;
  return manager;
}

struct StopManager {
  void operator()(libcamera::CameraManager* manager) const {
    delete manager;  // ends libcamera's thread
    TheManager& the = the_manager();
    {
      const std::lock_guard lock(the.mutex);
      the.exists = false;
    }
    the.gone.notify_all();
  }
};

std::string to_text(const std::vector<ListedCamera>& cameras) {
  std::string text;
  for (const ListedCamera& camera : cameras) {
    text += (text.empty() ? "\"" : ", \"") + camera.id + "\" (" + camera.model + ")";
  }
  return text.empty() ? "none" : text;
}

}  // namespace

Result<std::shared_ptr<libcamera::CameraManager>> camera_manager() {
  TheManager& the = the_manager();
  std::unique_lock lock(the.mutex);
  if (auto manager = the.share.lock()) return manager;
  the.gone.wait(lock, [&the] { return !the.exists; });
  auto starting = std::make_unique<libcamera::CameraManager>();
  if (const int error = starting->start(); error < 0) {
    return fail("libcamera does not start: " + std::generic_category().message(-error));
  }
  starting->cameraRemoved.connect(&the.watches,
                                  [&the](const std::shared_ptr<libcamera::Camera>& camera) {
                                    the.watches.notify(camera.get());
                                  });
  the.exists = true;
  const std::shared_ptr<libcamera::CameraManager> manager(starting.release(), StopManager{});
  the.share = manager;
  return manager;
}

std::string model_of(const libcamera::Camera& camera) {
  return camera.properties().get(libcamera::properties::Model).value_or("unknown");
}

std::vector<ListedCamera> list_cameras(const libcamera::CameraManager& manager) {
  std::vector<ListedCamera> cameras;
  for (const auto& camera : manager.cameras()) {
    cameras.push_back({camera->id(), model_of(*camera)});
  }
  return cameras;
}

Result<std::string> choose_camera(const std::vector<ListedCamera>& cameras,
                                  std::string_view wanted) {
  std::vector<ListedCamera> fitting;
  for (const ListedCamera& camera : cameras) {
    if (camera.id == wanted) return camera.id;
    if (camera.id.find(wanted) != std::string::npos ||
        camera.model.find(wanted) != std::string::npos) {
      fitting.push_back(camera);
    }
  }
  if (fitting.size() == 1) return fitting.front().id;
  const std::string name = "libcamera: camera \"" + std::string(wanted) + "\"";
  if (fitting.empty()) return fail(name + " is not there; there are: " + to_text(cameras));
  return fail(name + " could be any of " + to_text(fitting));
}

RemovalWatch::RemovalWatch(std::shared_ptr<const libcamera::Camera> camera,
                           std::function<void()> on_removed)
    : camera_(std::move(camera)), on_removed_(std::move(on_removed)) {
  RemovalWatches& all = the_manager().watches;
  const std::lock_guard lock(all.mutex);
  all.watches.push_back(this);
}

RemovalWatch::~RemovalWatch() {
  RemovalWatches& all = the_manager().watches;
  const std::lock_guard lock(all.mutex);
  std::erase(all.watches, this);
}

void RemovalWatch::notify(const libcamera::Camera* removed) const {
  if (removed == camera_.get()) on_removed_();
}

}  // namespace orbwatch::hal
