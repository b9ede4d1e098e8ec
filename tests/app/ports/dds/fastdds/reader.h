#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "tests/app/ports/dds/fastdds/participant.h"
#include "tests/app/ports/dds/fastdds/raw_type.h"

namespace eprosima::fastdds::dds {
class DataReader;
class Subscriber;
}  // namespace eprosima::fastdds::dds

namespace orbwatch::tests::fastdds {

using Clock = std::chrono::steady_clock;

struct ReaderSettings {
  std::string topic;
  std::string type;
  bool reliable = true;
  bool transient_local = false;
  int depth = 1;  ///< samples kept, newest first to stay
};

/// A reader of one topic whose samples stay bytes. The participant outlives it; a topic has one
/// reader per participant. Throws std::runtime_error when Fast DDS refuses. Thread-bound.
class Reader {
 public:
  Reader(Participant& participant, const ReaderSettings& settings);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next sample; nothing when none came in time.
  std::optional<RawSample> take(std::chrono::milliseconds patience);

  /// When the first writer was found whose QoS suits this reader.
  std::optional<std::chrono::steady_clock::time_point> first_match() const;

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
  eprosima::fastdds::dds::Subscriber* subscriber_ =
      nullptr;  ///< the participant's, as what follows
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;
};

}  // namespace orbwatch::tests::fastdds
