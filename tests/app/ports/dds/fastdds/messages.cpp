// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/dds/fastdds/messages.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/config.h>

#include <exception>

namespace orbwatch::tests::ros {

namespace {

using eprosima::fastcdr::Cdr;

#if FASTCDR_VERSION_MAJOR == 1
constexpr auto kCdrVersion = Cdr::DDS_CDR;
std::size_t consumed(const Cdr& cdr) { return cdr.getSerializedDataLength(); }
#else
constexpr auto kCdrVersion = eprosima::fastcdr::CdrVersion::DDS_CDR;
std::size_t consumed(const Cdr& cdr) { return cdr.get_serialized_data_length(); }
#endif

/// XCDR1 without parameter list, big-endian or little-endian (DDSI-RTPS 2.5, 10.5).
constexpr std::uint8_t kLastPlainEncapsulation = 1;
constexpr std::size_t kEncapsulationSize = 4;
constexpr std::size_t kMaxPadding = 3;

template <class Plain>
void read(Cdr& cdr, Plain& plain) {
  cdr >> plain;
}

void read(Cdr& cdr, Header& header) {
  cdr >> header.stamp.sec >> header.stamp.nanosec >> header.frame_id;
}

void read(Cdr& cdr, Image& image) {
  read(cdr, image.header);
  cdr >> image.height >> image.width >> image.encoding >> image.is_bigendian >> image.step >>
      image.data;
}

void read(Cdr& cdr, CompressedImage& image) {
  read(cdr, image.header);
  cdr >> image.format >> image.data;
}

void read(Cdr& cdr, CameraInfo& info) {
  read(cdr, info.header);
  cdr >> info.height >> info.width >> info.distortion_model >> info.d >> info.k >> info.r >>
      info.p >> info.binning_x >> info.binning_y;
  cdr >> info.roi.x_offset >> info.roi.y_offset >> info.roi.height >> info.roi.width >>
      info.roi.do_rectify;
}

void read(Cdr& cdr, KeyValue& pair) { cdr >> pair.key >> pair.value; }

void read(Cdr& cdr, Figure& figure) {
  cdr >> figure.name >> figure.value >> figure.unit >> figure.text;
}

void read(Cdr& cdr, Component& component);
void read(Cdr& cdr, DiagnosticStatus& status);
template <std::size_t size>
void read(Cdr& cdr, NodeEntitiesInfo<size>& node);

template <class Element>
void read(Cdr& cdr, std::vector<Element>& sequence) {
  std::uint32_t length = 0;
  cdr >> length;
  sequence.clear();
  // Grows with the data present, so that a wrong length ends the message instead of exhausting the
  // memory.
  for (std::uint32_t i = 0; i < length; ++i) read(cdr, sequence.emplace_back());
}

void read(Cdr& cdr, DiagnosticStatus& status) {
  cdr >> status.level >> status.name >> status.message >> status.hardware_id;
  read(cdr, status.values);
}

void read(Cdr& cdr, Component& component) {
  cdr >> component.kind >> component.name;
  read(cdr, component.figures);
}

void read(Cdr& cdr, ProcessState& state) {
  read(cdr, state.header);
  cdr >> state.frame_set >> state.trigger >> state.result >> state.recipe >>
      state.configuration_checksum >> state.system_state >> state.heartbeat;
  read(cdr, state.components);
}

void read(Cdr& cdr, Event& event) {
  read(cdr, event.header);
  cdr >> event.number >> event.kind >> event.source >> event.severity >> event.text;
  read(cdr, event.figures);
}

void read(Cdr& cdr, DiagnosticArray& array) {
  read(cdr, array.header);
  read(cdr, array.status);
}

template <std::size_t size>
void read(Cdr& cdr, NodeEntitiesInfo<size>& node) {
  cdr >> node.node_namespace >> node.node_name;
  read(cdr, node.reader_gids);
  read(cdr, node.writer_gids);
}

template <std::size_t size>
void read(Cdr& cdr, ParticipantEntitiesInfo<size>& info) {
  cdr >> info.gid;
  read(cdr, info.nodes);
}

}  // namespace

template <class Message>
std::optional<Message> decode(std::span<const std::uint8_t> cdr) {
  if (cdr.size() < kEncapsulationSize || cdr[0] != 0 || cdr[1] > kLastPlainEncapsulation) return {};
  // Fast-CDR takes non-const pointers, but reading changes nothing.
  auto* bytes = const_cast<char*>(reinterpret_cast<const char*>(cdr.data()));
  eprosima::fastcdr::FastBuffer buffer(bytes, cdr.size());
  Cdr reader(buffer, Cdr::DEFAULT_ENDIAN, kCdrVersion);
  Message message;
  try {
    reader.read_encapsulation();
    read(reader, message);
  } catch (const std::exception&) {
    return {};
  }
  if (cdr.size() - consumed(reader) > kMaxPadding) return {};
  return message;
}

template std::optional<Image> decode(std::span<const std::uint8_t>);
template std::optional<CompressedImage> decode(std::span<const std::uint8_t>);
template std::optional<CameraInfo> decode(std::span<const std::uint8_t>);
template std::optional<DiagnosticArray> decode(std::span<const std::uint8_t>);
template std::optional<ProcessState> decode(std::span<const std::uint8_t>);
template std::optional<Event> decode(std::span<const std::uint8_t>);
template std::optional<DiscoveryInfo> decode(std::span<const std::uint8_t>);
template std::optional<HumbleDiscoveryInfo> decode(std::span<const std::uint8_t>);

}  // namespace orbwatch::tests::ros
