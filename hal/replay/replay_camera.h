#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/camera.h"
#include "hal/fault_script.h"
#include "hal/frame_pool.h"
#include "hal/replay/recording.h"

namespace orbwatch::hal {

/// What a replay camera plays, and how.
struct ReplaySettings {
  std::string name;              ///< becomes CameraInfo::id
  std::filesystem::path source;  ///< a folder of JPEG or PNG pictures, or a video file
  double frame_rate = 0;         ///< per second; 0: the video's own, 30 for a folder
  bool loop = true;              ///< false: after the last picture the camera is unplugged
  std::vector<ScriptedFault> faults = {};
};

/// A camera that plays a recording. Exposure n is due at start + n / rate and shows picture
/// n modulo count, so several that start together stay in step. One that runs late by a period or
/// more leaves exposures out; the sequence shows the gap, as it does when all buffers are lent.
/// A picture that is damaged or differs from the first in size or format is withheld and reported.
class ReplayCamera : public Camera {
 public:
  explicit ReplayCamera(ReplaySettings settings);
  ~ReplayCamera() override;

 protected:
  /// Opens the recording. Errors: see open_recording; another size than asked for; a rate above
  /// 1000. The rate asked for here comes before the settings' one.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  void run(const std::stop_token& stop) override;

 private:
  bool expose(std::uint64_t exposure, TimePoint due, const std::stop_token& stop);

  ReplaySettings settings_;
  FaultScript script_;
  StreamFormat format_;
  std::unique_ptr<Recording> recording_;
  std::optional<FramePool> pool_;
};

}  // namespace orbwatch::hal
