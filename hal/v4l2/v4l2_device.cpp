#include "hal/v4l2/v4l2_device.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

namespace orbwatch::hal {
namespace {

/// More entries than any camera lists: a broken driver must not keep us enumerating.
constexpr std::uint32_t kMaxEntries = 256;

/// 0, or the error number.
template <class T>
int control(const FileDescriptor& file, unsigned long request, T& argument) {
  for (;;) {
    if (::ioctl(file.get(), request, &argument) == 0) return 0;
    if (errno != EINTR) return errno;
  }
}

/// V4L2's structures must be zero where nothing is asked for.
template <class T>
T cleared() {
  T value;
  std::memset(&value, 0, sizeof(value));
  return value;
}

v4l2_buffer capture_buffer(std::uint32_t index) {
  auto buffer = cleared<v4l2_buffer>();
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

std::string to_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Fault fault_of(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return Fault::Unplugged;
    default:
      return Fault::ReadError;
  }
}

std::string hint(int error) {
  switch (error) {
    case EBUSY:
      return "; another program uses the camera";
    case EACCES:
    case EPERM:
      return "; the user must be in the group of the device (video)";
    default:
      return "";
  }
}

}  // namespace

MappedMemory::MappedMemory(MappedMemory&& other) noexcept
    : memory_(std::exchange(other.memory_, {})) {}

MappedMemory::~MappedMemory() {
  if (!memory_.empty()) ::munmap(memory_.data(), memory_.size());
}

tl::unexpected<FaultReport> V4l2Device::failed(const std::string& action, int error) const {
  return tl::unexpected(FaultReport{
      fault_of(error),
      path_ + ": " + action + ": " + std::generic_category().message(error) + hint(error)});
}

DeviceResult<V4l2Device> V4l2Device::open(const std::string& path) {
  // Without O_NONBLOCK a broken camera could keep its thread inside VIDIOC_DQBUF for ever.
  FileDescriptor file(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  const int error = errno;
  V4l2Device device(path, std::move(file));
  if (!device.file_.is_open()) return device.failed("cannot be opened", error);
  if (auto usable = device.check_capabilities(); !usable) return tl::unexpected(usable.error());
  return device;
}

DeviceResult<> V4l2Device::check_capabilities() {
  const auto refuse = [this](const char* why) {
    return tl::unexpected(FaultReport{Fault::WrongFormat, path_ + ": " + why});
  };
  auto capability = cleared<v4l2_capability>();
  if (const int error = control(file_, VIDIOC_QUERYCAP, capability); error != 0) {
    if (fault_of(error) == Fault::Unplugged) return failed("cannot be asked what it is", error);
    return refuse("is not a V4L2 device");
  }
  const std::uint32_t abilities = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                      ? capability.device_caps
                                      : capability.capabilities;
  if ((abilities & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    return refuse("does not capture pictures; a camera may have several device nodes, try another");
  }
  if ((abilities & V4L2_CAP_STREAMING) == 0) return refuse("cannot stream into mapped buffers");
  const auto* name = reinterpret_cast<const char*>(capability.card);
  card_.assign(name, ::strnlen(name, sizeof(capability.card)));
  return {};
}

std::vector<std::uint32_t> V4l2Device::formats() const {
  std::vector<std::uint32_t> found;
  auto entry = cleared<v4l2_fmtdesc>();
  entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; entry.index < kMaxEntries && control(file_, VIDIOC_ENUM_FMT, entry) == 0; ++entry.index) {
    found.push_back(entry.pixelformat);
  }
  return found;
}

std::vector<std::string> V4l2Device::sizes(std::uint32_t pixel_format) const {
  std::vector<std::string> found;
  auto entry = cleared<v4l2_frmsizeenum>();
  entry.pixel_format = pixel_format;
  for (; entry.index < kMaxEntries && control(file_, VIDIOC_ENUM_FRAMESIZES, entry) == 0;
       ++entry.index) {
    if (entry.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      const auto& range = entry.stepwise;
      return {to_text(range.min_width, range.min_height) + ".." +
              to_text(range.max_width, range.max_height)};
    }
    found.push_back(to_text(entry.discrete.width, entry.discrete.height));
  }
  return found;
}

DeviceResult<v4l2_pix_format> V4l2Device::format() const {
  auto format = cleared<v4l2_format>();
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = control(file_, VIDIOC_G_FMT, format); error != 0) {
    return failed("cannot read the format", error);
  }
  return format.fmt.pix;
}

DeviceResult<v4l2_pix_format> V4l2Device::set_format(const v4l2_pix_format& wanted) {
  auto format = cleared<v4l2_format>();
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix = wanted;
  if (const int error = control(file_, VIDIOC_S_FMT, format); error != 0) {
    return failed("cannot set the format", error);
  }
  return format.fmt.pix;
}

DeviceResult<double> V4l2Device::set_frame_rate(double frame_rate) {
  auto parameters = cleared<v4l2_streamparm>();
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  int error = control(file_, VIDIOC_G_PARM, parameters);
  const auto& capture = parameters.parm.capture;
  if (error == ENOTTY || (error == 0 && (capture.capability & V4L2_CAP_TIMEPERFRAME) == 0)) {
    return 0.0;
  }
  if (error == 0 && frame_rate > 0) {
    parameters.parm.capture.timeperframe = {
        1000, static_cast<std::uint32_t>(std::lround(frame_rate * 1000))};
    error = control(file_, VIDIOC_S_PARM, parameters);
  }
  if (error != 0) return failed("cannot set the frame rate", error);
  const v4l2_fract period = capture.timeperframe;
  return period.numerator == 0 ? 0.0 : static_cast<double>(period.denominator) / period.numerator;
}

std::optional<v4l2_query_ext_ctrl> V4l2Device::next_control(std::uint32_t after) const {
  auto query = cleared<v4l2_query_ext_ctrl>();
  query.id = after | V4L2_CTRL_FLAG_NEXT_CTRL;
  if (control(file_, VIDIOC_QUERY_EXT_CTRL, query) != 0 || query.id <= after) return std::nullopt;
  return query;
}

DeviceResult<> V4l2Device::set_control(const v4l2_query_ext_ctrl& setting, std::int64_t value) {
  auto one = cleared<v4l2_ext_control>();
  one.id = setting.id;
  if (setting.type == V4L2_CTRL_TYPE_INTEGER64) {
    one.value64 = value;
  } else {
    one.value = static_cast<std::int32_t>(value);
  }
  auto controls = cleared<v4l2_ext_controls>();
  controls.which = V4L2_CTRL_WHICH_CUR_VAL;
  controls.count = 1;
  controls.controls = &one;
  if (const int error = control(file_, VIDIOC_S_EXT_CTRLS, controls); error != 0) {
    return failed("cannot set control \"" + std::string(setting.name) + "\"", error);
  }
  return {};
}

DeviceResult<std::uint32_t> V4l2Device::request_buffers(std::uint32_t count) {
  auto request = cleared<v4l2_requestbuffers>();
  request.count = count;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = control(file_, VIDIOC_REQBUFS, request); error != 0) {
    return failed("cannot get buffers", error);
  }
  return request.count;
}

DeviceResult<MappedMemory> V4l2Device::map_buffer(std::uint32_t index) {
  v4l2_buffer buffer = capture_buffer(index);
  if (const int error = control(file_, VIDIOC_QUERYBUF, buffer); error != 0) {
    return failed("cannot find buffer " + std::to_string(index), error);
  }
  void* const memory = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED,
                              file_.get(), static_cast<off_t>(buffer.m.offset));
  if (memory == MAP_FAILED) return failed("cannot map buffer " + std::to_string(index), errno);
  return MappedMemory({static_cast<std::byte*>(memory), buffer.length});
}

DeviceResult<> V4l2Device::queue(std::uint32_t index) {
  v4l2_buffer buffer = capture_buffer(index);
  if (const int error = control(file_, VIDIOC_QBUF, buffer); error != 0) {
    return failed("cannot queue a buffer", error);
  }
  return {};
}

DeviceResult<std::optional<v4l2_buffer>> V4l2Device::dequeue() {
  v4l2_buffer buffer = capture_buffer(0);
  const int error = control(file_, VIDIOC_DQBUF, buffer);
  if (error == EAGAIN) return std::nullopt;
  if (error != 0) return failed("cannot read a frame", error);
  return buffer;
}

DeviceResult<> V4l2Device::stream_on() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = control(file_, VIDIOC_STREAMON, type); error != 0) {
    return failed("cannot start the stream", error);
  }
  return {};
}

DeviceResult<> V4l2Device::stream_off() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = control(file_, VIDIOC_STREAMOFF, type); error != 0) {
    return failed("cannot stop the stream", error);
  }
  return {};
}

}  // namespace orbwatch::hal
