#include "hal/replay/recording.h"

#include <system_error>

#include "hal/replay/picture_folder.h"
#include "hal/replay/video_file.h"

namespace orbwatch::hal {

Result<std::unique_ptr<Recording>> open_recording(const std::filesystem::path& source, bool loop) {
  std::error_code error;
  const auto status = std::filesystem::status(source, error);
  if (error) return fail(source.string() + ": " + error.message());
  if (std::filesystem::is_directory(status)) return PictureFolder::open(source, loop);
  if (std::filesystem::is_regular_file(status)) return VideoFile::open(source, loop);
  return fail(source.string() + ": is neither a folder of pictures nor a video file");
}

}  // namespace orbwatch::hal
