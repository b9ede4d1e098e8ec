#include "hal/v4l2/device/v4l2_device.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include "hal/v4l2/device/device_call.h"

namespace orbwatch::hal {
namespace {

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

DriverFormat from_single_planar(const v4l2_pix_format& pix) {
  DriverFormat format{pix.width,
                      pix.height,
                      pix.pixelformat,
                      pix.field,
                      pix.colorspace,
                      pix.ycbcr_enc,
                      pix.quantization,
                      1,
                      {}};
  format.memory[0] = {pix.bytesperline, pix.sizeimage};
  return format;
}

DriverFormat from_multi_planar(const v4l2_pix_format_mplane& pix) {
  DriverFormat format{pix.width,     pix.height,       pix.pixelformat, pix.field, pix.colorspace,
                      pix.ycbcr_enc, pix.quantization, pix.num_planes,  {}};
  for (std::size_t i = 0; i < std::min<std::size_t>(pix.num_planes, kMaxPlanes); ++i) {
    format.memory[i] = {pix.plane_fmt[i].bytesperline, pix.plane_fmt[i].sizeimage};
  }
  return format;
}

}  // namespace

tl::unexpected<FaultReport> V4l2Device::failed(const std::string& action, int error) const {
  return tl::unexpected(FaultReport{
      fault_of(error),
      path_ + ": " + action + ": " + std::generic_category().message(error) + hint(error)});
}

DeviceResult<V4l2Device> V4l2Device::open(const std::string& path) {
  // Without O_NONBLOCK a broken camera could block its thread in VIDIOC_DQBUF.
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
  if (const int error = call(file_, VIDIOC_QUERYCAP, capability); error != 0) {
    if (fault_of(error) == Fault::Unplugged) return failed("cannot be queried", error);
    return refuse("is not a V4L2 device");
  }
  const std::uint32_t abilities = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                      ? capability.device_caps
                                      : capability.capabilities;
  if ((abilities & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE)) == 0) {
    return refuse("does not capture pictures; a camera may have several device nodes, try another");
  }
  if ((abilities & V4L2_CAP_STREAMING) == 0) return refuse("cannot stream into mapped buffers");
  if ((abilities & V4L2_CAP_VIDEO_CAPTURE) == 0) type_ = V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
  card_ = text_of(capability.card);
  driver_ = text_of(capability.driver);
  bus_ = text_of(capability.bus_info);
  return {};
}

DeviceResult<DriverFormat> V4l2Device::format() const {
  auto format = cleared<v4l2_format>();
  format.type = type_;
  if (const int error = call(file_, VIDIOC_G_FMT, format); error != 0) {
    return failed("cannot read the format", error);
  }
  return is_multi_planar() ? from_multi_planar(format.fmt.pix_mp)
                           : from_single_planar(format.fmt.pix);
}

DeviceResult<DriverFormat> V4l2Device::set_format(const DriverFormat& wanted) {
  auto format = cleared<v4l2_format>();
  format.type = type_;
  const auto ask = [&wanted](auto& pix) {
    pix.width = wanted.width;
    pix.height = wanted.height;
    pix.pixelformat = wanted.fourcc;
    pix.field = wanted.field;
  };
  if (is_multi_planar()) {
    ask(format.fmt.pix_mp);
  } else {
    ask(format.fmt.pix);
  }
  if (const int error = call(file_, VIDIOC_S_FMT, format); error != 0) {
    return failed("cannot set the format", error);
  }
  return is_multi_planar() ? from_multi_planar(format.fmt.pix_mp)
                           : from_single_planar(format.fmt.pix);
}

DeviceResult<double> V4l2Device::set_frame_rate(double frame_rate) {
  auto parameters = cleared<v4l2_streamparm>();
  parameters.type = type_;
  int error = call(file_, VIDIOC_G_PARM, parameters);
  const auto& capture = parameters.parm.capture;
  if (error == ENOTTY || (error == 0 && (capture.capability & V4L2_CAP_TIMEPERFRAME) == 0)) {
    return 0.0;
  }
  if (error == 0 && frame_rate > 0) {
    parameters.parm.capture.timeperframe = {
        1000, static_cast<std::uint32_t>(std::lround(frame_rate * 1000))};
    error = call(file_, VIDIOC_S_PARM, parameters);
  }
  if (error != 0) return failed("cannot set the frame rate", error);
  const v4l2_fract period = capture.timeperframe;
  return period.numerator == 0 ? 0.0 : static_cast<double>(period.denominator) / period.numerator;
}

}  // namespace orbwatch::hal
