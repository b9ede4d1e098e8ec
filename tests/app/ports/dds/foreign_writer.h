// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "app/ports/dds/participant/participant.h"
#include "tests/app/ports/dds/dds_network.h"

namespace orbwatch::app::tests {

/// Any program on the network: writes given samples, valid or not, without losses.
class ForeignWriter {
 public:
  ForeignWriter(int domain, const dds_topic_descriptor_t& type, const std::string& topic,
                dds::Qos qos, const std::optional<dds::SecuritySettings>& security = std::nullopt)
      : participant_(dds::Participant::join(domain, security).value()),
        topic_(make_topic(participant_.entity(), type, topic).value()) {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 100);
    writer_ = make_writer(participant_.entity(), topic_, qos).value();
  }

  bool has_reader() const {
    dds_publication_matched_status_t status{};
    EXPECT_EQ(dds_get_publication_matched_status(writer_.get(), &status), DDS_RETCODE_OK);
    return status.current_count > 0;
  }
  bool wait_for_reader() const {
    return eventually([this] { return has_reader(); });
  }
  void write(const void* sample) const {
    EXPECT_EQ(dds_write(writer_.get(), sample), DDS_RETCODE_OK);
  }
  /// Waits until every reader has all samples; returns whether that succeeded.
  bool flush() const { return dds_wait_for_acks(writer_.get(), DDS_SECS(60)) == DDS_RETCODE_OK; }

 private:
  dds::Participant participant_;
  dds::Entity topic_;
  dds::Entity writer_;
};

}  // namespace orbwatch::app::tests
