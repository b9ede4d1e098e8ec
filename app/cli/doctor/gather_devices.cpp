// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>

#include "app/cli/doctor/gather.h"
#include "app/health/system_file.h"
#include "hal/lines/find_line.h"
#include "hal/module/module_list.h"
#include "hal/recording/camera_recording.h"
#include "hal/replay/picture_decoder.h"
#include "hal/thread/file_descriptor.h"
#include "hal/v4l2/device/v4l2_list.h"

/// Facts about memory for cameras, cameras, chips of digital lines.
namespace orbwatch::app::cli::doctor {
namespace {

namespace fs = std::filesystem;

std::vector<Heap> heaps(const Sources& sources) {
  std::vector<Heap> found;
  std::vector<fs::path> nodes = entries(sources.at("/dev/dma_heap"));
  std::ranges::sort(nodes);
  for (const fs::path& node : nodes) {
    const hal::FileDescriptor heap(::open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
    const int error = errno;
    found.push_back({(fs::path("/dev/dma_heap") / node.filename()).string(),
                     heap.is_open() ? "" : hal::chip_error(node.string(), error)});
  }
  return found;
}

/// Finds a camera by the criterion of its back-end.
class Search {
 public:
  Search(const Sources& sources, std::string name) : sources_(sources), name_(std::move(name)) {}

  template <class Settings>
  CameraFacts operator()(const Settings& settings) const {
    constexpr hal::CameraOrigin kOrigin = Settings::kFacts.origin;
    if constexpr (kOrigin == hal::CameraOrigin::Process) {
      return {name_, "", Presence::Simulated};
    } else if constexpr (kOrigin == hal::CameraOrigin::Files) {
      return in_files(settings.address());
    } else if constexpr (kOrigin == hal::CameraOrigin::Kernel) {
      return in_kernel(settings.address());
    } else {
      return in_module(Settings::kName, settings.address(),
                       [&](const hal::CameraEntry& entry) { return settings.accepts(entry); });
    }
  }

 private:
  using Accepts = std::function<bool(const hal::CameraEntry&)>;

  CameraFacts missing(const std::string& address, std::string error,
                      const std::vector<hal::CameraEntry>& there) const;
  CameraFacts no_module(std::string_view module, const std::string& address,
                        std::string error) const;
  CameraFacts in_files(const std::string& address) const;
  CameraFacts in_kernel(const std::string& address) const;
  CameraFacts in_module(std::string_view back_end, const std::string& address,
                        const Accepts& accepts) const;

  const Sources& sources_;
  std::string name_;
};

CameraFacts Search::missing(const std::string& address, std::string error,
                            const std::vector<hal::CameraEntry>& there) const {
  CameraFacts facts{name_, address, Presence::Missing, std::move(error)};
  for (const hal::CameraEntry& camera : there) facts.others.push_back(camera.id);
  return facts;
}

CameraFacts Search::no_module(std::string_view module, const std::string& address,
                              std::string error) const {
  CameraFacts facts{name_, address, Presence::NoModule, std::move(error)};
  facts.module = module;
  return facts;
}

CameraFacts Search::in_files(const std::string& address) const {
  std::error_code unknown;
  if (fs::is_regular_file(address, unknown) && !hal::has_picture_name(address) &&
      !hal::recording::has_recording_name(address)) {
    if (const auto loaded = sources_.video_module(); !loaded) {
      return no_module(hal::kVideoModule, address, loaded.error().message);
    }
  }
  const bool there = fs::exists(address, unknown);
  return {name_, address, there ? Presence::There : Presence::Missing,
          there ? "" : "there is no such file"};
}

CameraFacts Search::in_kernel(const std::string& address) const {
  const fs::path dev = sources_.at("/dev");
  const auto node = hal::find_v4l2_device(
      address.starts_with('/') ? sources_.at(address).string() : address, dev);
  if (!node) return missing(address, node.error().detail, hal::list_v4l2_cameras(dev));
  const auto device = hal::V4l2Device::open(*node);
  if (device) return {name_, address, Presence::There};
  if (::access(node->c_str(), R_OK | W_OK) != 0 && errno == EACCES) {
    return {name_, address, Presence::Closed, hal::chip_error(*node, EACCES)};
  }
  return missing(address, device.error().detail, hal::list_v4l2_cameras(dev));
}

CameraFacts Search::in_module(std::string_view back_end, const std::string& address,
                              const Accepts& accepts) const {
  const auto cameras = sources_.module_cameras(back_end);
  if (!cameras) return no_module(back_end, address, cameras.error().message);
  const auto whole = std::ranges::count(*cameras, address, &hal::CameraEntry::id);
  const auto fitting = std::ranges::count_if(*cameras, accepts);
  if (whole == 1 || fitting == 1) return {name_, address, Presence::There};
  const auto broken = std::ranges::find_if(
      *cameras, [](const hal::CameraEntry& entry) { return !entry.problem.empty(); });
  std::string error =
      fitting > 1 ? "several cameras have this name" : std::string(back_end) + " has none so named";
  if (broken != cameras->end()) error = broken->problem;
  return missing(address, std::move(error), *cameras);
}

}  // namespace

void gather_devices(const Sources& sources, Facts& facts) {
  facts.heaps = heaps(sources);
  if (!facts.site) return;
  for (const files::CameraSettings& camera : facts.site->cameras) {
    facts.cameras.push_back(std::visit(Search(sources, camera.name), camera.back_end));
  }
  const bool has_lines = std::ranges::any_of(
      facts.site->lines, [](const LineSettings& line) { return line.back_end == LineKind::Gpio; });
  if (has_lines) facts.chips = sources.chips();
}

}  // namespace orbwatch::app::cli::doctor
