// SPDX-License-Identifier: Apache-2.0
#include <getopt.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/app/ports/dds/fastdds/json.h"
#include "tests/app/ports/dds/fastdds/reader.h"

/// Reads one topic with Fast DDS and prints each sample as a line of JSON.
namespace orbwatch::tests::fastdds {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr const char* kHelp =
    "fastdds_reader --topic TOPIC --type TYPE [options]\n"
    "\n"
    "Reads one topic with Fast DDS and prints JSON, one object a line: first what the writer\n"
    "announces, then each sample, last the figures of all. Ends by SIGTERM or as told.\n"
    "\n"
    "  --type TYPE             image, compressed_image, camera_info, diagnostics, process_state,\n"
    "                          event, discovery, humble_discovery; or the name of a type that is "
    "not decoded\n"
    "  --domain N              DDS domain (0)\n"
    "  --best-effort           instead of reliable\n"
    "  --transient-local       get what was written before, too\n"
    "  --receive-buffer BYTES  of the sockets (the system's default)\n"
    "  --count N, --seconds N  end after so many samples or so long\n"
    "  --slow MS               do nothing for so long after each sample\n"
    "  --save FILE             write what the newest picture's data is: pixels or JPEG\n"
    "  --quiet                 do not print samples\n";

struct Options {
  ParticipantSettings participant;
  ReaderSettings reader;
  std::uint64_t count = 0;  ///< 0: unlimited
  std::chrono::seconds seconds{0};
  std::chrono::milliseconds slow{0};
  std::string save;  ///< empty: data is not saved
  bool quiet = false;
};

volatile std::sig_atomic_t ended = 0;

/// A decoded sample.
struct Decoded {
  std::string members;             ///< members of its JSON object
  std::vector<std::uint8_t> data;  ///< data of a picture
};
/// Decodes a sample; nullopt: not decodable.
using Decoder = std::function<std::optional<Decoded>(const RawSample&)>;

struct KnownType {
  std::string name;
  Decoder decoder;
};

template <class Message>
KnownType known() {
  return {std::string(Message::kType), [](const RawSample& sample) -> std::optional<Decoded> {
            auto message = ros::decode<Message>(sample);
            if (!message) return std::nullopt;
            Decoded decoded{ros::json(*message), {}};
            if constexpr (requires { message->data; }) decoded.data = std::move(message->data);
            return decoded;
          }};
}

KnownType type_called(const std::string& word) {
  static const std::map<std::string, KnownType> kTypes{
      {"image", known<ros::Image>()},
      {"compressed_image", known<ros::CompressedImage>()},
      {"camera_info", known<ros::CameraInfo>()},
      {"diagnostics", known<ros::DiagnosticArray>()},
      {"process_state", known<ros::ProcessState>()},
      {"event", known<ros::Event>()},
      {"discovery", known<ros::DiscoveryInfo>()},
      {"humble_discovery", known<ros::HumbleDiscoveryInfo>()}};
  const auto found = kTypes.find(word);
  if (found != kTypes.end()) return found->second;
  return {word, [](const RawSample& sample) -> std::optional<Decoded> {
            return Decoded{"\"length\": " + std::to_string(sample.size()), {}};
          }};
}

std::optional<Options> parse(int argc, char** argv) {
  enum Letter {
    kTopic,
    kType,
    kDomain,
    kBestEffort,
    kTransient,
    kBuffer,
    kCount,
    kSeconds,
    kSlow,
    kSave,
    kQuiet
  };
  constexpr option kOptions[] = {{"topic", required_argument, nullptr, kTopic},
                                 {"type", required_argument, nullptr, kType},
                                 {"domain", required_argument, nullptr, kDomain},
                                 {"best-effort", no_argument, nullptr, kBestEffort},
                                 {"transient-local", no_argument, nullptr, kTransient},
                                 {"receive-buffer", required_argument, nullptr, kBuffer},
                                 {"count", required_argument, nullptr, kCount},
                                 {"seconds", required_argument, nullptr, kSeconds},
                                 {"slow", required_argument, nullptr, kSlow},
                                 {"save", required_argument, nullptr, kSave},
                                 {"quiet", no_argument, nullptr, kQuiet},
                                 {nullptr, 0, nullptr, 0}};
  Options options;
  for (int letter = 0; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    const long number = optarg == nullptr ? 0 : std::strtol(optarg, nullptr, 10);
    switch (letter) {
      case kTopic:
        options.reader.topic = optarg;
        break;
      case kType:
        options.reader.type = optarg;
        break;
      case kDomain:
        options.participant.domain = static_cast<int>(number);
        break;
      case kBestEffort:
        options.reader.reliable = false;
        break;
      case kTransient:
        options.reader.transient_local = true;
        break;
      case kBuffer:
        options.participant.receive_buffer = static_cast<std::uint32_t>(number);
        break;
      case kCount:
        options.count = static_cast<std::uint64_t>(number);
        break;
      case kSeconds:
        options.seconds = std::chrono::seconds(number);
        break;
      case kSlow:
        options.slow = std::chrono::milliseconds(number);
        break;
      case kSave:
        options.save = optarg;
        break;
      case kQuiet:
        options.quiet = true;
        break;
      default:
        return std::nullopt;
    }
  }
  if (options.reader.topic.empty() || options.reader.type.empty() || optind < argc) {
    return std::nullopt;
  }
  return options;
}

void say(const std::string& members) {
  std::printf("{%s}\n", members.c_str());
  std::fflush(stdout);
}

/// Output of one run.
class Run {
 public:
  explicit Run(const Options& options)
      : options_(options),
        type_(type_called(options.reader.type)),
        participant_(options.participant),
        reader_(participant_, {options.reader.topic, type_.name, options.reader.reliable,
                               options.reader.transient_local, options.reader.depth}) {}

  void read() {
    const auto begin = Clock::now();
    while (ended == 0 && (options_.count == 0 || samples_ < options_.count) &&
           (options_.seconds.count() == 0 || Clock::now() - begin < options_.seconds)) {
      const auto sample = reader_.take(std::chrono::milliseconds(10));
      note_match();
      if (!sample) continue;
      note(*sample);
      if (options_.slow.count() > 0) std::this_thread::sleep_for(options_.slow);
    }
    save();
    say("\"samples\": " + std::to_string(samples_) + ", \"undecodable\": " +
        std::to_string(undecodable_) + ", \"bytes\": " + std::to_string(bytes_));
  }

 private:
  void note_match() {
    if (matched_) return;
    matched_ = reader_.first_match();
    if (!matched_) return;
    for (const Announcement& writer : participant_.announcements()) {
      if (writer.topic != options_.reader.topic) continue;
      say("\"matched\": " + ros::quoted(writer.topic) + ", \"guid\": " + ros::quoted(writer.guid) +
          ", \"type\": " + ros::quoted(writer.type) +
          ", \"user_data\": " + ros::quoted(writer.user_data));
    }
  }

  void note(const RawSample& sample) {
    ++samples_;
    bytes_ += sample.size();
    auto decoded = type_.decoder(sample);
    if (!decoded) ++undecodable_;
    if (!options_.quiet) {
      const auto age = matched_ ? Clock::now() - *matched_ : Clock::duration::zero();
      say("\"since_match_ms\": " + std::to_string(Milliseconds(age).count()) + ", " +
          (decoded ? decoded->members : "\"undecodable\": true"));
    }
    if (decoded && !options_.save.empty()) newest_ = std::move(decoded->data);
  }

  void save() const {
    if (options_.save.empty()) return;
    std::ofstream file(options_.save, std::ios::binary);
    file.write(reinterpret_cast<const char*>(newest_.data()),
               static_cast<std::streamsize>(newest_.size()));
    if (!file.flush()) throw std::runtime_error("cannot write " + options_.save);
  }

  const Options options_;
  const KnownType type_;
  Participant participant_;
  Reader reader_;
  std::optional<Clock::time_point> matched_;
  std::uint64_t samples_ = 0;
  std::uint64_t undecodable_ = 0;
  std::uint64_t bytes_ = 0;
  std::vector<std::uint8_t> newest_;
};

int main(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) {
    std::fputs(kHelp, stderr);
    return 2;
  }
  for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, [](int) { ended = 1; });
  try {
    Run(*options).read();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fastdds_reader: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace orbwatch::tests::fastdds

int main(int argc, char** argv) { return orbwatch::tests::fastdds::main(argc, argv); }
