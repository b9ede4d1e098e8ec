// SPDX-License-Identifier: Apache-2.0
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/ports/dds/commands/command_request.h"
#include "app/ports/dds/commands/request_ledger.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/topics/topic_names.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "tests/fuzz/byte_stream.h"
#include "tests/fuzz/stop.h"
#include "tests/support/loopback_dds.h"

/// A program of the domain that sends anything as commands: a sample that Cyclone DDS accepts is
/// the request that was sent, and the handler gets allowed commands only, each at most once.
///
/// An input is samples: a length, and that number of bytes in the form of a DATA submessage.
namespace orbwatch::fuzz {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kHeader = 4;  ///< representation and options

/// True for version 2 of CDR. Left out because of a fault outside of the product: Cyclone DDS
/// 0.10.2 reads its 8 byte numbers as 4 byte ones when it compares with the sample's length, and
/// reads beyond the sample.
bool is_version_2(Bytes sample) { return sample[0] == 0 && sample[1] >= 6; }

/// A sample in the layout of DDSI-RTPS 2.5, 10, read without Cyclone DDS.
class WireCommand {
 public:
  explicit WireCommand(Bytes sample) : body_(sample.subspan(kHeader)) {
    const bool is_little = sample[1] % 2 == 1;
    is_swapped_ = is_little != (std::endian::native == std::endian::little);
    client = number_of<std::uint64_t>();
    number = number_of<std::uint64_t>();
    const auto length = number_of<std::uint32_t>();
    const Bytes text = bytes(length);
    name.assign(text.begin(), std::ranges::find(text, 0));
    argument_count = number_of<std::uint32_t>();
    for (std::size_t i = 0; i < std::min(argument_count, app::kMaxArguments); ++i) {
      arguments.push_back(number_of<std::uint64_t>());
    }
  }

  std::uint64_t client = 0, number = 0;
  std::string name;  ///< up to its first zero
  std::size_t argument_count = 0;
  /// Bits of the arguments, at most as many as a command may have.
  std::vector<std::uint64_t> arguments;

 private:
  Bytes bytes(std::size_t count) {
    require(count <= body_.size() - place_, "a sample that ends too early was accepted");
    return body_.subspan(std::exchange(place_, place_ + count), count);
  }
  template <class T>
  T number_of() {
    bytes((sizeof(T) - place_ % sizeof(T)) % sizeof(T));
    std::array<std::uint8_t, sizeof(T)> raw{};
    std::ranges::copy(bytes(sizeof(T)), raw.begin());
    if (is_swapped_) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }

  Bytes body_;
  std::size_t place_ = 0;
  bool is_swapped_ = false;
};

void compare(const app::dds::CommandRequest& request, const WireCommand& sent) {
  require(request.id == app::dds::RequestId{sent.client, sent.number}, "another id than was sent");
  require(sent.name.starts_with(request.name), "another name than was sent");
  const bool is_known = app::find_command(sent.name) != nullptr;
  require(is_known == (app::find_command(request.name) != nullptr), "a name that was cut is known");
  require(request.argument_count == sent.argument_count, "another number of arguments");
  for (std::size_t i = 0; i < sent.arguments.size(); ++i) {
    require(std::bit_cast<std::uint64_t>(request.arguments[i]) == sent.arguments[i],
            "another argument than was sent");
  }
}

/// A writer and the command topic's reader in one domain, which no packet leaves. Constructed once.
class Network {
 public:
  Network()
      : domain_(dds_create_domain(kDomain, tests::loopback_dds().c_str())),
        participant_(app::dds::Participant::join(kDomain).value()),
        topic_(app::dds::make_topic(participant_.entity(), orbwatch_msgs_msg_dds__Command__desc,
                                    name())
                   .value()),
        writer_(
            app::dds::make_writer(participant_.entity(), topic_, app::dds::command_qos()).value()) {
    require(reader_.open(participant_.entity(), app::dds::command_qos()).has_value(), "no reader");
    // Cyclone DDS's internal type is available only with a sample.
    const app::dds::CommandMessage first{1, 1, const_cast<char*>(""), {}};
    require(dds_write(writer_.get(), &first) == DDS_RETCODE_OK, "nothing can be written");
    dds_sample_info_t info{};
    require(dds_takecdr(reader_.get(), &first_, 1, &info, DDS_ANY_STATE) == 1, "nothing came");
  }

  /// The request made from a sample; nullopt if the sample is not valid.
  std::optional<app::dds::CommandRequest> receive(Bytes sample) {
    // Cyclone DDS changes the bytes of its own copy only.
    ddsrt_iovec_t piece{const_cast<std::uint8_t*>(sample.data()), sample.size()};
    ddsi_serdata* const read =
        ddsi_serdata_from_ser_iov(first_->type, SDK_DATA, 1, &piece, sample.size());
    if (read == nullptr) return std::nullopt;
    require(dds_writecdr(writer_.get(), read) == DDS_RETCODE_OK, "not delivered");
    std::optional<app::dds::CommandRequest> request;
    const auto taken = app::dds::take_samples(reader_.get(), [&](const void* message, const auto&) {
      request = app::dds::request_of(*static_cast<const app::dds::CommandMessage*>(message));
    });
    require(taken && *taken == 1 && request, "a sample that was read did not come");
    return request;
  }

 private:
  static constexpr int kDomain = 1;
  static std::string name() { return app::dds::command_topic("orbwatch"); }

  app::dds::Entity domain_;
  app::dds::Participant participant_;
  app::dds::Entity topic_;
  app::dds::Entity writer_;
  app::dds::TopicReader reader_{orbwatch_msgs_msg_dds__Command__desc, name()};
  ddsi_serdata* first_ = nullptr;
};

/// Executes requests like CommandService, without its limit of commands per second.
class Machine {
 public:
  void serve(const app::dds::CommandRequest& request) {
    if (ledger_.judge(request.id) != app::dds::RequestLedger::Verdict::New) return;
    const app::dds::CommandAnswer answer =
        app::dds::carry_out(request, [&](const app::Command& command) {
          require(app::check(command) == app::CommandResult::Done, "a command that is not allowed");
          require(std::exchange(newest_[request.id.client], request.id.number) < request.id.number,
                  "a command was carried out again");
          return app::CommandResult::Done;
        });
    require(answer.text.find('\n') == std::string::npos, "an answer of several lines");
    ledger_.record(request.id, answer);
  }

 private:
  app::dds::RequestLedger ledger_{app::CommandRecord::kMaxClients};
  std::map<std::uint64_t, std::uint64_t> newest_;
};

void run(ByteStream bytes) {
  static Network network;
  Machine machine;
  while (!bytes.is_empty()) {
    const Bytes sample = bytes.take(bytes.byte());
    if (sample.size() < kHeader) continue;  // dropped before it is read
    if (is_version_2(sample)) continue;
    const auto request = network.receive(sample);
    if (!request) continue;
    compare(*request, WireCommand(sample));
    machine.serve(*request);
  }
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orbwatch::fuzz::run(orbwatch::fuzz::ByteStream({data, size}));
  return 0;
}
