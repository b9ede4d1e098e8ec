#include "app/dds/picture_topics.h"

#include "app/dds/topic_names.h"

namespace orbwatch::app {

PictureTopics::PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg)
    : raw_(raw, std::make_unique<RawPictureWriter>(encoding)),
      compressed_(compressed_topic(raw), std::make_unique<JpegPictureWriter>(jpeg), jpeg.rate) {}

Result<> PictureTopics::open(const Entity& participant) {
  return raw_.open(participant).and_then([&] { return compressed_.open(participant); });
}

void PictureTopics::close() {
  raw_.close();
  compressed_.close();
}

void PictureTopics::accept(const StampedPicture& picture) {
  raw_.accept(picture);
  compressed_.accept(picture);
}

void PictureTopics::report(std::vector<TopicStatistics>& topics) const {
  topics.push_back(raw_.statistics());
  topics.push_back(compressed_.statistics());
}

}  // namespace orbwatch::app
