#include "app/dds/image_topic.h"

#include <cstring>

namespace orbwatch::app {

namespace {

/// ROS 2's hash of sensor_msgs/msg/Image, as its middleware announces it.
constexpr std::string_view kTypeHash =
    "typehash=RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47;";

std::size_t row_bytes(const ImagePlane& plane) {
  return static_cast<std::size_t>(plane.width) * plane.encoding.bytes_per_pixel();
}

}  // namespace

ImagePlane colour_plane(const ImageView<std::uint8_t>& image) {
  return {kRgb8, image.width, image.height, image.stride, image.data};
}

ImagePlane radiometric_plane(const ImageView<std::uint16_t>& image) {
  return {kMono16, image.width, image.height,
          image.stride * static_cast<std::ptrdiff_t>(sizeof(std::uint16_t)),
          reinterpret_cast<std::uint8_t*>(image.data)};
}

ImageTopic::ImageTopic(std::string name)
    : writer_(sensor_msgs_msg_dds__Image__desc, std::move(name)) {}

Result<> ImageTopic::open(const Entity& participant) {
  const Qos qos = frame_qos();
  dds_qset_userdata(qos.get(), kTypeHash.data(), kTypeHash.size());
  return writer_.open(participant, qos);
}

void ImageTopic::publish(const ImagePlane& plane, std::string& frame_id, const TimeMessage& stamp) {
  if (!writer_.has_reader()) {
    writer_.count_unread();
    return;
  }
  const std::size_t step = row_bytes(plane);
  const auto size = static_cast<std::uint32_t>(step * static_cast<std::size_t>(plane.height));
  const bool contiguous = plane.stride == static_cast<std::ptrdiff_t>(step);

  // The C API takes no const pointers, but a write changes nothing.
  ImageMessage message{};
  message.header.stamp = stamp;
  message.header.frame_id = frame_id.data();
  message.height = static_cast<std::uint32_t>(plane.height);
  message.width = static_cast<std::uint32_t>(plane.width);
  message.encoding = const_cast<char*>(plane.encoding.name.data());
  message.is_bigendian = kBigEndianHost ? 1 : 0;
  message.step = static_cast<std::uint32_t>(step);
  message.data = {size, size, contiguous ? plane.data : packed_rows(plane), false};
  writer_.write(&message);
}

std::uint8_t* ImageTopic::packed_rows(const ImagePlane& plane) {
  const std::size_t step = row_bytes(plane);
  packed_.resize(step * static_cast<std::size_t>(plane.height));
  for (int y = 0; y < plane.height; ++y) {
    std::memcpy(packed_.data() + static_cast<std::size_t>(y) * step, plane.data + y * plane.stride,
                step);
  }
  return packed_.data();
}

}  // namespace orbwatch::app
