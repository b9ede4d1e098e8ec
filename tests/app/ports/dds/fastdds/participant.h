#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace eprosima::fastdds::dds {
class DomainParticipant;
}

namespace orbwatch::tests::fastdds {

/// What a writer on the network says of itself.
struct Announcement {
  std::string guid;  ///< 16 bytes in hexadecimal
  std::string topic;
  std::string type;
  std::string user_data;
};

struct ParticipantSettings {
  int domain = 0;
  std::uint32_t receive_buffer = 0;  ///< bytes, of its sockets; 0: what the system gives
};

/// A participant of Fast DDS, the other vendor, over UDP alone and otherwise as its defaults are:
/// every interface there is when it is made, on the network namespace of the thread that makes it.
/// Throws std::runtime_error when there is none. Thread-safe.
class Participant {
 public:
  explicit Participant(const ParticipantSettings& settings);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  eprosima::fastdds::dds::DomainParticipant& get() const { return *participant_; }

  /// Of the writers that are known now.
  std::vector<Announcement> announcements() const;

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
};

}  // namespace orbwatch::tests::fastdds
