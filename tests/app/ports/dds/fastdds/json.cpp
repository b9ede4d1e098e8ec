// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/dds/fastdds/json.h"

#include <zlib.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace orbwatch::tests::ros {

namespace {

/// Quoted hexadecimal text, two digits per byte.
template <class Number, std::size_t size>
std::string hexadecimal(const std::array<Number, size>& numbers) {
  std::ostringstream out;
  out << '"' << std::hex << std::setfill('0');
  for (const Number number : numbers) out << std::setw(2 * sizeof number) << +number;
  out << '"';
  return out.str();
}

/// Collects `"name": value`, separated by commas.
class Members {
 public:
  Members& text(const char* name, const std::string& value) { return raw(name, quoted(value)); }

  template <class Number>
  Members& number(const char* name, Number value) {
    std::ostringstream out;
    out << std::setprecision(std::numeric_limits<double>::max_digits10) << +value;
    return raw(name, out.str());
  }

  template <class List, class Writer>
  Members& list(const char* name, const List& list, const Writer& writer) {
    std::string items;
    for (const auto& item : list) items += (items.empty() ? "" : ", ") + writer(item);
    return raw(name, "[" + items + "]");
  }

  template <class Numbers>
  Members& numbers(const char* name, const Numbers& values) {
    return list(name, values, [](double value) {
      std::ostringstream out;
      out << std::setprecision(std::numeric_limits<double>::max_digits10) << value;
      return out.str();
    });
  }

  Members& raw(const char* name, const std::string& value) {
    members_ += (members_.empty() ? "\"" : ", \"") + std::string(name) + "\": " + value;
    return *this;
  }

  Members& header(const Header& header) {
    return number("sec", header.stamp.sec)
        .number("nanosec", header.stamp.nanosec)
        .text("frame_id", header.frame_id);
  }

  Members& data(const std::vector<std::uint8_t>& data) {
    return number("length", data.size())
        .raw("crc32", hexadecimal(std::array{
                          static_cast<std::uint32_t>(crc32_z(0, data.data(), data.size()))}));
  }

  const std::string& str() const { return members_; }

 private:
  std::string members_;
};

std::string object(const Members& members) { return "{" + members.str() + "}"; }

template <std::size_t size>
std::string discovery(const ParticipantEntitiesInfo<size>& info) {
  const auto node = [](const NodeEntitiesInfo<size>& entry) {
    return object(Members()
                      .text("namespace", entry.node_namespace)
                      .text("name", entry.node_name)
                      .list("readers", entry.reader_gids, hexadecimal<std::uint8_t, size>)
                      .list("writers", entry.writer_gids, hexadecimal<std::uint8_t, size>));
  };
  return Members().raw("gid", hexadecimal(info.gid)).list("nodes", info.nodes, node).str();
}

std::string status_object(const DiagnosticStatus& status) {
  const auto pair = [](const KeyValue& value) {
    return object(Members().text("key", value.key).text("value", value.value));
  };
  return object(Members()
                    .number("level", status.level)
                    .text("name", status.name)
                    .text("message", status.message)
                    .text("hardware_id", status.hardware_id)
                    .list("values", status.values, pair));
}

std::string figure_object(const Figure& figure) {
  Members members;
  members.text("name", figure.name);
  std::isfinite(figure.value) ? members.number("value", figure.value)
                              : members.text("value", "not valid");
  return object(members.text("unit", figure.unit).text("text", figure.text));
}

std::string component_object(const Component& component) {
  return object(Members()
                    .text("kind", component.kind)
                    .text("name", component.name)
                    .list("figures", component.figures, figure_object));
}

}  // namespace

std::string quoted(const std::string& text) {
  constexpr unsigned char kFirstPrintable = 0x20;
  std::ostringstream out;
  out << '"' << std::hex << std::setfill('0');
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out << '\\' << c;
    } else if (code < kFirstPrintable) {
      out << "\\u" << std::setw(4) << +code;
    } else {
      out << c;
    }
  }
  out << '"';
  return out.str();
}

std::string json(const Image& image) {
  return Members()
      .header(image.header)
      .number("height", image.height)
      .number("width", image.width)
      .text("encoding", image.encoding)
      .number("is_bigendian", image.is_bigendian)
      .number("step", image.step)
      .data(image.data)
      .str();
}

std::string json(const CompressedImage& image) {
  return Members().header(image.header).text("format", image.format).data(image.data).str();
}

std::string json(const CameraInfo& info) {
  const Members roi = Members()
                          .number("x_offset", info.roi.x_offset)
                          .number("y_offset", info.roi.y_offset)
                          .number("height", info.roi.height)
                          .number("width", info.roi.width)
                          .raw("do_rectify", info.roi.do_rectify ? "true" : "false");
  return Members()
      .header(info.header)
      .number("height", info.height)
      .number("width", info.width)
      .text("distortion_model", info.distortion_model)
      .numbers("d", info.d)
      .numbers("k", info.k)
      .numbers("r", info.r)
      .numbers("p", info.p)
      .number("binning_x", info.binning_x)
      .number("binning_y", info.binning_y)
      .raw("roi", object(roi))
      .str();
}

std::string json(const DiagnosticArray& array) {
  return Members().header(array.header).list("status", array.status, status_object).str();
}

std::string json(const ProcessState& state) {
  return Members()
      .header(state.header)
      .number("frame_set", state.frame_set)
      .number("trigger", state.trigger)
      .number("result", state.result)
      .number("recipe", state.recipe)
      .number("configuration_checksum", state.configuration_checksum)
      .number("system_state", state.system_state)
      .number("heartbeat", state.heartbeat)
      .list("components", state.components, component_object)
      .str();
}

std::string json(const Event& event) {
  return Members()
      .header(event.header)
      .number("number", event.number)
      .text("kind", event.kind)
      .text("source", event.source)
      .number("severity", event.severity)
      .text("text", event.text)
      .list("figures", event.figures, figure_object)
      .str();
}

std::string json(const DiscoveryInfo& info) { return discovery(info); }
std::string json(const HumbleDiscoveryInfo& info) { return discovery(info); }

}  // namespace orbwatch::tests::ros
