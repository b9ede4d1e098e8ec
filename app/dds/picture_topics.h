#pragma once

#include <string>
#include <vector>

#include "app/dds/picture_topic.h"

namespace orbwatch::app {

/// One picture in both forms that ROS' image_transport knows, as it is and as JPEG.
/// Thread rule: as PictureTopic.
class PictureTopics {
 public:
  /// `raw` is the name of the sensor_msgs/Image topic; `encoding` Rgb, Bgr or Grey.
  PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg);

  Result<> open(const Entity& participant);
  void close();
  void accept(const StampedPicture& picture);
  std::vector<const TopicWriter*> writers() const {
    return {&raw_.writer(), &compressed_.writer()};
  }
  void report(std::vector<TopicStatistics>& topics) const;

 private:
  PictureTopic raw_;
  PictureTopic compressed_;
};

}  // namespace orbwatch::app
