// What a device offers: formats, sizes, rates and controls.
#include "hal/v4l2/device/device_call.h"
#include "hal/v4l2/device/v4l2_device.h"

namespace orbwatch::hal {
namespace {

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
  if (const int error = call(file_, VIDIOC_S_EXT_CTRLS, controls); error != 0) {
    return failed("cannot set control \"" + text_of(setting.name) + "\"", error);
  }
  return {};
}

}  // namespace orbwatch::hal
