#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "app/cli/doctor/gather.h"
#include "app/health/system_file.h"
#include "hal/lines/find_line.h"
#include "hal/thread/file_descriptor.h"
#include "hal/v4l2/device/v4l2_list.h"

/// Memory of cameras, cameras, chips of digital lines.
namespace orbwatch::app::doctor {
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

/// What a camera is found by, for each back-end.
class Search {
 public:
  Search(const Sources& sources, std::string name) : sources_(sources), name_(std::move(name)) {}

  CameraFacts operator()(const simulation::SimulatedCameraSettings&) const {
    return {name_, "", Presence::Simulated};
  }
  CameraFacts operator()(const hal::TestPatternSettings&) const {
    return {name_, "", Presence::Simulated};
  }
  CameraFacts operator()(const hal::ReplaySettings& replay) const {
    std::error_code unknown;
    const bool there = fs::exists(replay.source, unknown);
    return {name_, replay.source.string(), there ? Presence::There : Presence::Missing,
            there ? "" : "there is no such file"};
  }
  CameraFacts operator()(const hal::V4l2Settings& v4l2) const;
  CameraFacts operator()(const hal::LibcameraSettings& camera) const;
  CameraFacts operator()(const hal::GenicamSettings& camera) const;

 private:
  CameraFacts missing(const std::string& address, std::string error,
                      const std::vector<hal::CameraEntry>& there) const;
  /// A camera of a back-end that is a module; `is_named` says which of its cameras it is.
  template <class IsNamed>
  CameraFacts in_module(std::string_view back_end, const std::string& wanted,
                        const IsNamed& is_named) const;

  const Sources& sources_;
  std::string name_;
};

CameraFacts Search::missing(const std::string& address, std::string error,
                            const std::vector<hal::CameraEntry>& there) const {
  CameraFacts facts{name_, address, Presence::Missing, std::move(error)};
  for (const hal::CameraEntry& camera : there) facts.others.push_back(camera.id);
  return facts;
}

CameraFacts Search::operator()(const hal::V4l2Settings& v4l2) const {
  const fs::path dev = sources_.at("/dev");
  const std::string& address = v4l2.device;
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

template <class IsNamed>
CameraFacts Search::in_module(std::string_view back_end, const std::string& wanted,
                              const IsNamed& is_named) const {
  const auto cameras = sources_.module_cameras(back_end);
  if (!cameras) {
    CameraFacts facts{name_, wanted, Presence::NoModule, cameras.error().message};
    facts.module = back_end;
    return facts;
  }
  const auto whole = std::ranges::count(*cameras, wanted, &hal::CameraEntry::id);
  const auto fitting = std::ranges::count_if(*cameras, is_named);
  if (whole == 1 || fitting == 1) return {name_, wanted, Presence::There};
  const auto broken = std::ranges::find_if(
      *cameras, [](const hal::CameraEntry& entry) { return !entry.problem.empty(); });
  std::string error =
      fitting > 1 ? "several cameras have this name" : std::string(back_end) + " has none so named";
  if (broken != cameras->end()) error = broken->problem;
  return missing(wanted, std::move(error), *cameras);
}

CameraFacts Search::operator()(const hal::LibcameraSettings& camera) const {
  // As libcamera's module chooses: the whole id, or a part of id or model that one camera has.
  return in_module(
      hal::LibcameraSettings::kName, camera.camera, [&camera](const hal::CameraEntry& entry) {
        return entry.problem.empty() && (entry.id.find(camera.camera) != std::string::npos ||
                                         entry.model.find(camera.camera) != std::string::npos);
      });
}

CameraFacts Search::operator()(const hal::GenicamSettings& camera) const {
  // A camera that orbwatchd controls answers, but cannot be opened: it is there.
  return in_module(hal::GenicamSettings::kName, camera.camera,
                   [&camera](const hal::CameraEntry& entry) {
                     return std::ranges::find(entry.paths, camera.camera) != entry.paths.end();
                   });
}

}  // namespace

void gather_devices(const Sources& sources, Facts& facts) {
  facts.heaps = heaps(sources);
  if (!facts.site) return;
  for (const CameraSettings& camera : facts.site->cameras) {
    facts.cameras.push_back(std::visit(Search(sources, camera.name), camera.back_end));
  }
  const bool has_lines = std::ranges::any_of(
      facts.site->lines, [](const LineSettings& line) { return line.back_end == LineKind::Gpio; });
  if (has_lines) facts.chips = sources.chips();
}

}  // namespace orbwatch::app::doctor
