// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/v4l2_device.h"

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

/// Larger than the entries of any camera; bounds the enumeration with a broken driver.
constexpr std::uint32_t kMaxEntries = 256;

/// One ioctl, repeated when a signal interrupts it: 0, or the error number.
template <class T>
int call(const FileDescriptor& file, unsigned long request, T& argument) {
  for (;;) {
    if (::ioctl(file.get(), request, &argument) == 0) return 0;
    if (errno != EINTR) return errno;
  }
}

/// Unused members of V4L2's structures must be zero.
template <class T>
T cleared() {
  T value;
  std::memset(&value, 0, sizeof(value));
  return value;
}

/// The text of a structure's field, which need not be zero-terminated.
template <class Byte, std::size_t N>
std::string text_of(const Byte (&field)[N]) {
  const auto* text = reinterpret_cast<const char*>(field);
  return {text, ::strnlen(text, N)};
}

/// Fault for a failed call.
Fault fault_of(int error) {
  return error == ENOENT || error == ENODEV || error == ENXIO ? Fault::Unplugged : Fault::ReadError;
}

std::string hint(int error) {
  if (error == EBUSY) return "; another program uses the camera";
  if (error != EACCES && error != EPERM) return "";
  return "; the user must be in the group of the device (video)";
}

/// The members that both of V4L2's structures have.
template <class Pix>
DriverFormat picture_format(const Pix& pix, std::size_t memory_count) {
  return {pix.width,     pix.height,       pix.pixelformat, pix.field, pix.colorspace,
          pix.ycbcr_enc, pix.quantization, memory_count,    {}};
}

DriverFormat driver_format(const v4l2_format& described) {
  if (described.type != V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
    const v4l2_pix_format& pix = described.fmt.pix;
    DriverFormat format = picture_format(pix, 1);
    format.memory[0] = {pix.bytesperline, pix.sizeimage};
    return format;
  }
  const v4l2_pix_format_mplane& pix = described.fmt.pix_mp;
  DriverFormat format = picture_format(pix, pix.num_planes);
  for (std::size_t i = 0; i < std::min<std::size_t>(pix.num_planes, kMaxPlanes); ++i) {
    format.memory[i] = {pix.plane_fmt[i].bytesperline, pix.plane_fmt[i].sizeimage};
  }
  return format;
}

double rate_of(const v4l2_fract& period) {
  return period.numerator == 0 ? 0 : static_cast<double>(period.denominator) / period.numerator;
}

v4l2_ext_controls only(v4l2_ext_control& one) {
  auto controls = cleared<v4l2_ext_controls>();
  controls.which = V4L2_CTRL_WHICH_CUR_VAL;
  controls.count = 1;
  controls.controls = &one;
  return controls;
}

}  // namespace

tl::unexpected<FaultReport> V4l2Device::failed(const std::string& action, int error) const {
  return fail(fault_of(error),
              path_ + ": " + action + ": " + std::generic_category().message(error) + hint(error));
}

template <class T>
DeviceResult<> V4l2Device::request(unsigned long code, T& argument,
                                   const std::string& action) const {
  if (const int error = call(file_, code, argument); error != 0) return failed(action, error);
  return {};
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
    return fail(Fault::WrongFormat, path_ + ": " + why);
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
  return driver_format(format);
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
  return driver_format(format);
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
  return rate_of(capture.timeperframe);
}

struct V4l2Device::BufferQuery {
  BufferQuery(std::uint32_t type, BufferOwner owner, std::uint32_t index)
      : buffer(cleared<v4l2_buffer>()), planes(cleared<decltype(planes)>()) {
    buffer.index = index;
    buffer.type = type;
    buffer.memory = static_cast<std::uint32_t>(owner);
    if (type != V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) return;
    buffer.m.planes = planes.data();
    buffer.length = static_cast<std::uint32_t>(planes.size());
  }
  BufferQuery(const BufferQuery&) = delete;
  BufferQuery& operator=(const BufferQuery&) = delete;

  /// Sets the dma-bufs to fill, for either interface.
  void import(std::span<const BufferMemory> memory) {
    const bool single = buffer.type != V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
    for (std::size_t i = 0; i < memory.size() && i < planes.size(); ++i) {
      planes[i].m.fd = memory[i].dma_buffer->descriptor();
      planes[i].length = static_cast<std::uint32_t>(memory[i].mapping.bytes().size());
    }
    buffer.length = single ? planes[0].length : static_cast<std::uint32_t>(memory.size());
    if (single) buffer.m.fd = planes[0].m.fd;
  }

  v4l2_buffer buffer;
  std::array<v4l2_plane, VIDEO_MAX_PLANES> planes;
};

bool V4l2Device::may_import() const {
  auto request = cleared<v4l2_requestbuffers>();
  request.type = type_;
  request.memory = V4L2_MEMORY_MMAP;
  if (call(file_, VIDIOC_REQBUFS, request) != 0) return false;
  return request.capabilities == 0 || (request.capabilities & V4L2_BUF_CAP_SUPPORTS_DMABUF) != 0;
}

DeviceResult<std::uint32_t> V4l2Device::request_buffers(std::uint32_t count, BufferOwner owner) {
  auto request = cleared<v4l2_requestbuffers>();
  request.count = count;
  request.type = type_;
  request.memory = static_cast<std::uint32_t>(owner);
  if (const int error = call(file_, VIDIOC_REQBUFS, request); error != 0) {
    return failed("cannot get buffers", error);
  }
  owner_ = owner;
  return request.count;
}

DeviceResult<> V4l2Device::free_buffers() {
  auto none = cleared<v4l2_requestbuffers>();
  none.type = type_;
  none.memory = static_cast<std::uint32_t>(owner_);
  return request(VIDIOC_REQBUFS, none, "cannot free buffers");
}

DeviceResult<std::vector<BufferMemory>> V4l2Device::map_buffer(std::uint32_t index) {
  BufferQuery query(type_, owner_, index);
  if (const int error = call(file_, VIDIOC_QUERYBUF, query.buffer); error != 0) {
    return failed("cannot find buffer " + std::to_string(index), error);
  }
  if (!is_multi_planar()) {
    query.planes[0].length = query.buffer.length;
    query.planes[0].m.mem_offset = query.buffer.m.offset;
    query.buffer.length = 1;
  }
  std::vector<BufferMemory> memory;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(query.buffer.length, kMaxPlanes); ++i) {
    const v4l2_plane& plane = query.planes[i];
    auto mapped = map_memory(index, i, plane.length, plane.m.mem_offset);
    if (!mapped) return tl::unexpected(mapped.error());
    memory.push_back(std::move(*mapped));
  }
  return memory;
}

DeviceResult<BufferMemory> V4l2Device::map_memory(std::uint32_t index, std::uint32_t number,
                                                  std::size_t length, std::uint32_t offset) {
  std::optional<DmaBuffer> exported = export_memory(index, number);
  const int file = exported ? exported->descriptor() : file_.get();
  void* const memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, file,
                              exported ? 0 : static_cast<off_t>(offset));
  if (memory == MAP_FAILED) return failed("cannot map buffer " + std::to_string(index), errno);
  return BufferMemory{MappedMemory({static_cast<std::byte*>(memory), length}), std::move(exported)};
}

/// Nullopt when the driver does not export: then its own mapping is used.
std::optional<DmaBuffer> V4l2Device::export_memory(std::uint32_t index, std::uint32_t number) {
  auto request = cleared<v4l2_exportbuffer>();
  request.type = type_;
  request.index = index;
  request.plane = number;
  request.flags = O_CLOEXEC | O_RDWR;
  if (call(file_, VIDIOC_EXPBUF, request) != 0) return std::nullopt;
  return DmaBuffer(FileDescriptor(request.fd));
}

DeviceResult<> V4l2Device::queue(std::uint32_t index, std::span<const BufferMemory> memory) {
  BufferQuery query(type_, owner_, index);
  if (owner_ == BufferOwner::Importer) query.import(memory);
  return request(VIDIOC_QBUF, query.buffer, "cannot queue a buffer");
}

DeviceResult<std::optional<FilledBuffer>> V4l2Device::dequeue() {
  BufferQuery query(type_, owner_, 0);
  const int error = call(file_, VIDIOC_DQBUF, query.buffer);
  if (error == EAGAIN) return std::nullopt;
  if (error != 0) return failed("cannot read a frame", error);
  const v4l2_buffer& buffer = query.buffer;
  FilledBuffer filled{buffer.index, buffer.flags, buffer.sequence, buffer.timestamp, {}};
  if (!is_multi_planar()) {
    filled.samples[0] = {0, buffer.bytesused};
    return filled;
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(buffer.length, kMaxPlanes); ++i) {
    const v4l2_plane& plane = query.planes[i];
    // bytesused includes the offset; a larger offset leaves no samples.
    filled.samples[i] = {plane.data_offset,
                         plane.bytesused - std::min(plane.bytesused, plane.data_offset)};
  }
  return filled;
}

DeviceResult<> V4l2Device::stream_on() {
  return request(VIDIOC_STREAMON, type_, "cannot start the stream");
}

DeviceResult<> V4l2Device::stream_off() {
  return request(VIDIOC_STREAMOFF, type_, "cannot stop the stream");
}

std::vector<std::uint32_t> V4l2Device::formats() const {
  std::vector<std::uint32_t> found;
  auto entry = cleared<v4l2_fmtdesc>();
  entry.type = type_;
  for (; entry.index < kMaxEntries && call(file_, VIDIOC_ENUM_FMT, entry) == 0; ++entry.index) {
    found.push_back(entry.pixelformat);
  }
  return found;
}

std::vector<FrameSizeOffer> V4l2Device::sizes(std::uint32_t fourcc) const {
  std::vector<FrameSizeOffer> found;
  auto entry = cleared<v4l2_frmsizeenum>();
  entry.pixel_format = fourcc;
  for (; entry.index < kMaxEntries && call(file_, VIDIOC_ENUM_FRAMESIZES, entry) == 0;
       ++entry.index) {
    if (entry.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      const auto& range = entry.stepwise;
      return {{range.min_width, range.max_width, range.min_height, range.max_height}};
    }
    const auto& size = entry.discrete;
    found.push_back({size.width, size.width, size.height, size.height});
  }
  return found;
}

std::vector<double> V4l2Device::frame_rates(std::uint32_t fourcc, std::uint32_t width,
                                            std::uint32_t height) const {
  std::vector<double> found;
  auto entry = cleared<v4l2_frmivalenum>();
  entry.pixel_format = fourcc;
  entry.width = width;
  entry.height = height;
  for (; entry.index < kMaxEntries && call(file_, VIDIOC_ENUM_FRAMEINTERVALS, entry) == 0;
       ++entry.index) {
    if (entry.type != V4L2_FRMIVAL_TYPE_DISCRETE) {
      return {rate_of(entry.stepwise.max), rate_of(entry.stepwise.min)};
    }
    found.push_back(rate_of(entry.discrete));
  }
  return found;
}

std::optional<v4l2_query_ext_ctrl> V4l2Device::next_control(std::uint32_t after) const {
  auto query = cleared<v4l2_query_ext_ctrl>();
  query.id = after | V4L2_CTRL_FLAG_NEXT_CTRL;
  if (call(file_, VIDIOC_QUERY_EXT_CTRL, query) != 0 || query.id <= after) return std::nullopt;
  return query;
}

std::optional<std::string> V4l2Device::menu_entry(const v4l2_query_ext_ctrl& setting,
                                                  std::int64_t index) const {
  auto entry = cleared<v4l2_querymenu>();
  entry.id = setting.id;
  entry.index = static_cast<std::uint32_t>(index);
  if (call(file_, VIDIOC_QUERYMENU, entry) != 0) return std::nullopt;
  if (setting.type == V4L2_CTRL_TYPE_INTEGER_MENU) return std::to_string(entry.value);
  return text_of(entry.name);
}

DeviceResult<std::int64_t> V4l2Device::control(const v4l2_query_ext_ctrl& setting) const {
  auto one = cleared<v4l2_ext_control>();
  one.id = setting.id;
  auto controls = only(one);
  if (const int error = call(file_, VIDIOC_G_EXT_CTRLS, controls); error != 0) {
    return failed("cannot read control \"" + text_of(setting.name) + "\"", error);
  }
  return setting.type == V4L2_CTRL_TYPE_INTEGER64 ? std::int64_t{one.value64}
                                                  : std::int64_t{one.value};
}

DeviceResult<> V4l2Device::set_control(const v4l2_query_ext_ctrl& setting, std::int64_t value) {
  auto one = cleared<v4l2_ext_control>();
  one.id = setting.id;
  if (setting.type == V4L2_CTRL_TYPE_INTEGER64) {
    one.value64 = value;
  } else {
    one.value = static_cast<std::int32_t>(value);
  }
  auto controls = only(one);
  return request(VIDIOC_S_EXT_CTRLS, controls,
                 "cannot set control \"" + text_of(setting.name) + "\"");
}

}  // namespace orbwatch::hal
