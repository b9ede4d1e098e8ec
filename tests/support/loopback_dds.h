// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <string>

namespace orbwatch::tests {

/// Settings of Cyclone DDS for a network on the loopback interface only; a tag of this process
/// excludes every other test. `more` is inserted in <Domain>, `discovery` in <Discovery>.
inline std::string loopback_dds(const std::string& more = "", const std::string& discovery = "") {
  return "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
         "<AllowMulticast>false</AllowMulticast></General><Discovery>" +
         discovery + "<Tag>orbwatch_tests_" + std::to_string(getpid()) +
         "</Tag>"
         "<ParticipantIndex>auto</ParticipantIndex>"
         "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
         "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>" +
         more + "</Domain></CycloneDDS>";
}

}  // namespace orbwatch::tests
