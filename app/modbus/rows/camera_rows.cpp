#include "app/modbus/codes.h"
#include "app/modbus/rows/block.h"
#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

static_assert(kCameraBlock + int{kMaxCameras} * kCameraStride <= kViewBlock);

std::chrono::milliseconds last_frame_age(const CameraStatus& camera, const Snapshot& snapshot) {
  using std::chrono::milliseconds;
  if (camera.last_frame == hal::TimePoint{}) return milliseconds::max();
  return std::chrono::duration_cast<milliseconds>(snapshot.now - camera.last_frame);
}

std::vector<Row> rows_of_camera(std::size_t index) {
  const int base = kCameraBlock + static_cast<int>(index) * kCameraStride;
  Block<CameraStatus> block(
      Table::Input, base, "camera_" + std::to_string(index) + "_",
      [index](const Snapshot& s) -> const CameraStatus& { return s.live.status.cameras[index]; });
  block
      .u16("fault", range_of(camera_fault_codes()), listed(camera_fault_codes()),
           [index](const CameraStatus& camera, const Snapshot& s) {
             return index < s.live.status.camera_count ? static_cast<std::uint16_t>(camera.fault)
                                                       : kNone;
           })
      .u16("frames_per_second", kRate, "Over the last full second",
           &CameraStatus::frames_per_second)
      .u16("latency_p50", kLatency, "Exposure start to arrival, median of the last full second",
           &CameraStatus::latency_p50_ms)
      .u16("latency_p99", kLatency, "Exposure start to arrival, 99 of 100 are faster",
           &CameraStatus::latency_p99_ms)
      .u32("last_frame_age", kAge,
           "Since its newest good frame came; stays at 2147483647, also when none came yet",
           last_frame_age)
      .u32("frames", kCounter, "Frames delivered since start", &CameraStatus::frames)
      .u32("lost", kCounter, "Frames missing in the camera's sequence", &CameraStatus::lost)
      .u32("dropped", kCounter,
           "Frames not used: a newer one was there, the queue was full, or the camera had a fault",
           &CameraStatus::dropped)
      .u32("unmatched", kCounter,
           "Frames delivered while the pacing camera had none of that moment",
           &CameraStatus::unmatched)
      .u32("triggers", kCounter, "Edges of its trigger line since start", &CameraStatus::triggers)
      .u32("missed", kCounter, "Triggers without a frame: faster than the camera, or its fault",
           &CameraStatus::missed);
  return block.reserved_to(base + kCameraStride).rows();
}

}  // namespace

std::vector<Row> camera_rows() { return joined(kMaxCameras, rows_of_camera); }

}  // namespace orbwatch::app::modbus
