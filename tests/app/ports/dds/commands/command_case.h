// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/dds/command_client.h"
#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/topics/topic_names.h"
#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/foreign_writer.h"
#include "tests/app/ports/dds/topic_reader.h"

/// A machine and its controller for tests of commands over DDS.
namespace orbwatch::app::dds::command_case {

/// Handler of the sink's commands, which refuses everything except view 0.
class Machine {
 public:
  CommandHandler handler() {
    return [this](const Command& command) {
      const std::lock_guard lock(mutex_);
      commands_.push_back(command);
      return command.code == CommandCode::SelectView && command.integer(0) > 0
                 ? CommandResult::ArgumentOutOfRange
                 : CommandResult::Done;
    };
  }
  std::vector<Command> commands() const {
    const std::lock_guard lock(mutex_);
    return commands_;
  }
  std::size_t count() const { return commands().size(); }

 private:
  mutable std::mutex mutex_;
  std::vector<Command> commands_;
};

/// A controller that sends any message and reads all results.
class Controller {
 public:
  Controller()
      : requests_(tests::DdsNetwork::kReaderDomain, orbwatch_msgs_msg_dds__Command__desc,
                  command_topic("orbwatch"), command_qos()),
        results_(orbwatch_msgs_msg_dds__CommandResult__desc, command_result_topic("orbwatch"),
                 command_qos()) {}

  bool connect() const {
    return requests_.wait_for_reader() && tests::eventually([this] {
             dds_subscription_matched_status_t matched{};
             return dds_get_subscription_matched_status(results_.get(), &matched) ==
                        DDS_RETCODE_OK &&
                    matched.current_count > 0;
           });
  }

  void send(RequestId id, std::string name, std::vector<double> arguments) const {
    const auto count = static_cast<std::uint32_t>(arguments.size());
    const CommandMessage message{
        id.client, id.number, name.data(), {count, count, arguments.data(), false}};
    requests_.write(&message);
  }

  /// Sends until an answer to this request arrives; the first one may be written before the sink
  /// has matched this reader.
  CommandAnswer ask(RequestId id, const std::string& name,
                    const std::vector<double>& arguments) const {
    CommandAnswer answer{CommandResult::Busy, "no answer"};
    EXPECT_TRUE(tests::eventually([&] {
      send(id, name, arguments);
      bool answered = false;
      results_.take([&](const CommandResultMessage& message) {
        if (RequestId{message.client, message.number} != id) return;
        answer = {static_cast<CommandResult>(message.result), message.text};
        answered = true;
      });
      return answered;
    }));
    return answer;
  }

  const tests::ForeignWriter& requests() const { return requests_; }

 private:
  tests::ForeignWriter requests_;
  tests::TopicReader<CommandResultMessage> results_;
};

inline DdsSettings command_settings() {
  return {.domain = tests::DdsNetwork::kSinkDomain, .commands = true};
}

/// Sends a command as `orbwatch command` does.
inline Result<CommandAnswer> send(const Command& command, std::chrono::milliseconds timeout) {
  const std::atomic<bool> cancelled{false};
  return cli::send_command({.domain = tests::DdsNetwork::kReaderDomain, .timeout = timeout},
                           command, cancelled);
}

}  // namespace orbwatch::app::dds::command_case
