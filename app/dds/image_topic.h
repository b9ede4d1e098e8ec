#pragma once

#include <string>
#include <vector>

#include "app/dds/image_message.h"
#include "app/dds/time_message.h"
#include "app/dds/topic_writer.h"
#include "proc/image/image_view.h"

namespace orbwatch::app {

/// One plane of a view as an image topic wants it.
struct ImagePlane {
  ImageEncoding encoding;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;     ///< bytes
  std::uint8_t* data = nullptr;  ///< only read
};

/// The plane of `image`, which stays the owner of the pixels.
ImagePlane colour_plane(const ImageView<std::uint8_t>& image);
ImagePlane radiometric_plane(const ImageView<std::uint16_t>& image);

/// One topic of sensor_msgs/Image. Thread rule: as TopicWriter.
class ImageTopic {
 public:
  explicit ImageTopic(std::string name);

  /// Creates the writer; does nothing when there is one.
  Result<> open(const Entity& participant);
  void close() { writer_.close(); }

  /// Writes the plane, or counts it as unread. Pixels are handed to DDS in place; only rows with
  /// padding are packed first, into memory that is kept.
  void publish(const ImagePlane& plane, std::string& frame_id, const TimeMessage& stamp);

  TopicStatistics statistics() const { return writer_.statistics(); }

 private:
  std::uint8_t* packed_rows(const ImagePlane& plane);

  TopicWriter writer_;
  std::vector<std::uint8_t> packed_;
};

}  // namespace orbwatch::app
