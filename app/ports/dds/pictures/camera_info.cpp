#include "app/ports/dds/pictures/camera_info.h"

#include <algorithm>
#include <array>

namespace orbwatch::app {
namespace {

// The C API takes no const pointers, but a write changes nothing.
constexpr std::string_view kPlumbBob = "plumb_bob";
constexpr std::array<double, 5> kNoDistortion{};

CameraInfoMessage message_of(const optics::Intrinsics& view) {
  CameraInfoMessage message{};
  message.height = static_cast<std::uint32_t>(view.height);
  message.width = static_cast<std::uint32_t>(view.width);
  message.distortion_model = const_cast<char*>(kPlumbBob.data());
  message.d = {kNoDistortion.size(), kNoDistortion.size(),
               const_cast<double*>(kNoDistortion.data()), false};
  const std::array k{view.fx, 0.0,     view.cx,  //
                     0.0,     view.fy, view.cy,  //
                     0.0,     0.0,     1.0};
  const std::array r{1.0, 0.0, 0.0,  //
                     0.0, 1.0, 0.0,  //
                     0.0, 0.0, 1.0};
  const std::array p{view.fx, 0.0,     view.cx, 0.0,  //
                     0.0,     view.fy, view.cy, 0.0,  //
                     0.0,     0.0,     1.0,     0.0};
  std::ranges::copy(k, message.k);
  std::ranges::copy(r, message.r);
  std::ranges::copy(p, message.p);
  return message;
}

}  // namespace

Result<CameraInfoMessage> camera_info(const optics::ViewSpec& view, std::string& frame_id,
                                      const TimeMessage& stamp) {
  const auto projection = optics::ViewProjection::make(view);
  if (!projection) return tl::unexpected(projection.error());
  const auto intrinsics = projection->intrinsics();
  if (!intrinsics) return fail("camera_info: view " + frame_id + " is not a perspective one");
  CameraInfoMessage message = message_of(*intrinsics);
  message.header = {stamp, frame_id.data()};
  return message;
}

}  // namespace orbwatch::app
