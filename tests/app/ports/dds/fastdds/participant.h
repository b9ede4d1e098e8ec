// SPDX-License-Identifier: Apache-2.0
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

/// Announcement of a writer on the network.
struct Announcement {
  std::string guid;  ///< 16 bytes in hexadecimal
  std::string topic;
  std::string type;
  std::string user_data;
};

struct ParticipantSettings {
  int domain = 0;
  /// Receive buffer of its sockets, bytes; 0: the system's default.
  std::uint32_t receive_buffer = 0;
};

/// A participant of Fast DDS, the other vendor, over UDP only and otherwise with its defaults:
/// every interface present at its creation, in the network namespace of the creating thread. Throws
/// std::runtime_error if it cannot be created. Thread-safe.
class Participant {
 public:
  explicit Participant(const ParticipantSettings& settings);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  eprosima::fastdds::dds::DomainParticipant& get() const { return *participant_; }

  /// Announcements of the presently known writers.
  std::vector<Announcement> announcements() const;

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
};

}  // namespace orbwatch::tests::fastdds
