// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/camera_info.h"

#include <algorithm>
#include <array>

#include "proc/optics/named_distortion.h"

namespace orbwatch::app::dds {
namespace {

// The C API takes non-const pointers, but a write changes nothing.
template <class T>
T* unchanged(const T* data) {
  return const_cast<T*>(data);
}

}  // namespace

CameraInfoMessage camera_info(const optics::Intrinsics& lens, const std::string& frame_id,
                              const TimeMessage& stamp) {
  const auto [model, count] = optics::named_distortion(lens);
  const auto length = static_cast<std::uint32_t>(count);
  CameraInfoMessage message{};
  message.header = {stamp, unchanged(frame_id.c_str())};
  message.height = static_cast<std::uint32_t>(lens.height);
  message.width = static_cast<std::uint32_t>(lens.width);
  message.distortion_model = unchanged(model.data());
  message.d = {length, length, unchanged(lens.coefficients.data()), false};
  const std::array k{lens.fx, 0.0,     lens.cx,  //
                     0.0,     lens.fy, lens.cy,  //
                     0.0,     0.0,     1.0};
  const std::array r{1.0, 0.0, 0.0,  //
                     0.0, 1.0, 0.0,  //
                     0.0, 0.0, 1.0};
  const std::array p{lens.fx, 0.0,     lens.cx, 0.0,  //
                     0.0,     lens.fy, lens.cy, 0.0,  //
                     0.0,     0.0,     1.0,     0.0};
  std::ranges::copy(k, message.k);
  std::ranges::copy(r, message.r);
  std::ranges::copy(p, message.p);
  return message;
}

Result<optics::Intrinsics> lens_of(const optics::ViewSpec& view) {
  const auto projection = optics::ViewProjection::make(view);
  if (!projection) return tl::unexpected(projection.error());
  const auto intrinsics = projection->intrinsics();
  if (!intrinsics) return fail("only a perspective view has a camera_info");
  return *intrinsics;
}

}  // namespace orbwatch::app::dds
