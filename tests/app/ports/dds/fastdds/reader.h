// SPDX-License-Identifier: Apache-2.0
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
  int depth = 1;  ///< samples kept, the newest ones
};

/// A reader of one topic whose samples stay bytes. The participant outlives it; a topic has one
/// reader per participant. Throws std::runtime_error on a failure of Fast DDS. Thread-bound.
class Reader {
 public:
  Reader(Participant& participant, const ReaderSettings& settings);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next sample; nullopt: none in time.
  std::optional<RawSample> take(std::chrono::milliseconds patience);

  /// Time at which the first writer with compatible QoS was matched.
  std::optional<std::chrono::steady_clock::time_point> first_match() const;

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
  /// Owned by the participant, like the following members.
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;
};

}  // namespace orbwatch::tests::fastdds
