#include "app/pictures/picture_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <string>
#include <vector>

#include "proc/align/first_plane.h"
#include "proc/image/image_view.h"

namespace orbwatch::app {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

/// Of a file that write_file() has not renamed yet: NAME.PROCESS-SERIAL.part
bool is_temporary(const std::filesystem::path& path) {
  static const std::regex kName(R"(.+\.\d+-\d+\.part)");
  return std::regex_match(path.filename().string(), kName);
}

tl::unexpected<Error> cannot_write(const std::filesystem::path& path) {
  return fail(path.string() + ": cannot be written: " + std::strerror(errno));
}

/// In OpenCV's order of channels.
cv::Mat to_bgr(const Picture& picture) {
  const cv::Mat rgb = align::first_plane(picture);
  if (rgb.channels() == 1) return rgb;
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

cv::Mat with_alpha(const cv::Mat& picture, const ImageView<const std::uint8_t>& validity) {
  cv::Mat bgra;
  cv::cvtColor(picture, bgra, picture.channels() == 1 ? cv::COLOR_GRAY2BGRA : cv::COLOR_BGR2BGRA);
  const cv::Mat seen(validity.height, validity.width, CV_8U,
                     const_cast<std::uint8_t*>(validity.data),
                     static_cast<std::size_t>(validity.stride));
  cv::Mat alpha;
  cv::Mat(seen == static_cast<int>(Validity::Seen))
      .convertTo(alpha, bgra.depth(), bgra.depth() == CV_16U ? 257 : 1);
  cv::insertChannel(alpha, bgra, 3);
  return bgra;
}

}  // namespace

Result<> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  static std::atomic<unsigned> serial{0};
  const std::string temporary =
      path.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".part";
  const int file = ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) return cannot_write(path);
  // The lock, which ends with the process, says that the file is no leftover. Where a file system
  // has no locks, leftovers are not removed either.
  static_cast<void>(::flock(file, LOCK_EX));
  const bool written = write_all(file, bytes) && ::fsync(file) == 0;
  const int reason = errno;
  const bool closed = ::close(file) == 0;
  if (written && closed && ::rename(temporary.c_str(), path.c_str()) == 0) return {};
  if (!written) errno = reason;
  auto error = cannot_write(path);
  ::unlink(temporary.c_str());
  return error;
}

Result<> write_file(const std::filesystem::path& path, std::string_view text) {
  return write_file(path,
                    std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

Result<> remove_unfinished(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (!is_temporary(it->path())) continue;
    const int file = ::open(it->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) continue;  // renamed meanwhile, or not ours
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove(it->path(), error);
    ::close(file);
  }
  if (error) return fail(folder.string() + ": " + error.message());
  return {};
}

Result<> check_picture_name(const std::filesystem::path& path, PixelFormat format,
                            bool transparency) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") return {};
  if (extension != ".jpg" && extension != ".jpeg") {
    return fail(path.string() +
                ": unknown kind of picture; its name must end in .png, .jpg or .jpeg");
  }
  if (transparency) return fail(path.string() + ": JPEG has no transparency; write a .png");
  if (info(format).bytes_per_sample() == 2) {
    return fail(path.string() + ": JPEG holds 8 bit, the picture has 16; write a .png");
  }
  return {};
}

Result<> write_picture(const std::filesystem::path& path, const Picture& picture,
                       const ImageView<const std::uint8_t>& validity) {
  if (auto named = check_picture_name(path, picture.format, !validity.empty()); !named)
    return named;
  std::vector<std::uint8_t> bytes;
  try {
    const cv::Mat bgr = to_bgr(picture);
    const cv::Mat encoded = validity.empty() ? bgr : with_alpha(bgr, validity);
    const bool jpeg = lower_extension(path) != ".png";
    const std::vector<int> options =
        jpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 95} : std::vector<int>{};
    if (!cv::imencode(jpeg ? ".jpg" : ".png", encoded, bytes, options)) {
      return fail(path.string() + ": the picture cannot be encoded");
    }
  } catch (const cv::Exception& error) {
    return fail(path.string() + ": the picture cannot be encoded: " + error.err);
  }
  return write_file(path, bytes);
}

}  // namespace orbwatch::app
