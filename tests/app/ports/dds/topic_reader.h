// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "app/ports/dds/participant/participant.h"
#include "tests/app/ports/dds/dds_network.h"

namespace orbwatch::app::tests {

/// A plain reader of one topic, by default on the readers' side of the network.
template <class Message>
class TopicReader {
 public:
  using Look = std::function<void(const Message&)>;

  TopicReader(const dds_topic_descriptor_t& type, const std::string& topic, const dds::Qos& qos,
              int domain = DdsNetwork::kReaderDomain,
              const std::optional<dds::SecuritySettings>& security = std::nullopt)
      : participant_(dds::Participant::join(domain, security).value()),
        topic_(make_topic(participant_.entity(), type, topic).value()),
        reader_(make_reader(participant_.entity(), topic_, qos).value()),
        condition_(dds_create_readcondition(reader_.get(), DDS_ANY_STATE)),
        waitset_(dds_create_waitset(participant_.entity().get())) {
    EXPECT_EQ(dds_waitset_attach(waitset_.get(), condition_.get(), 0), DDS_RETCODE_OK);
  }

  dds_entity_t get() const { return reader_.get(); }

  /// Waits briefly; returns whether there is data.
  bool wait() const { return dds_waitset_wait(waitset_.get(), nullptr, 0, DDS_MSECS(20)) > 0; }

  /// Waits briefly; passes the next sample to `look` if one arrived.
  bool take(const Look& look) const {
    if (!wait()) return false;
    void* sample = nullptr;
    dds_sample_info_t info{};
    const dds_return_t count = dds_take(reader_.get(), &sample, &info, 1, 1);
    EXPECT_GE(count, 0) << dds_strretcode(count);
    const bool valid = count > 0 && info.valid_data;
    if (valid) look(*static_cast<const Message*>(sample));
    if (count > 0) {
      EXPECT_EQ(dds_return_loan(reader_.get(), &sample, count), DDS_RETCODE_OK);
    }
    return valid;
  }

  /// Takes samples until none arrives for a moment.
  void drain() const {
    while (take([](const Message&) {})) {
    }
  }

 private:
  dds::Participant participant_;
  dds::Entity topic_;
  dds::Entity reader_;
  dds::Entity condition_;
  dds::Entity waitset_;
};

}  // namespace orbwatch::app::tests
