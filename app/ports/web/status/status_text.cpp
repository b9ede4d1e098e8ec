#include "app/ports/web/status/status_text.h"

#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/model/json.h"
#include "app/model/readings.h"
#include "app/model/utc_text.h"

namespace orbwatch::app::web {
namespace {

const Component kWeb{"web"};

/// The samples of one figure, which the format wants together.
struct Metric {
  std::string help;
  std::string samples;
};

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\' || c == '"') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string number_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The figures by their metric's name.
class Metrics {
 public:
  template <class Part>
  void add(const Component& component, const Part& part, hal::TimePoint now) {
    for_each_field(std::type_identity<Part>{}, [&](const auto& field) {
      add(component, field, reading_of(field, std::invoke(field.get, part), now));
    });
  }
  void add(const InterfaceMetric& figure) {
    const FieldInfo& field = figure.field;
    add(figure.component, field, {field.name, figure.value, field.unit});
  }

  std::string text() const {
    std::string all;
    for (const auto& [name, metric] : metrics_) {
      all.append("# HELP ").append(name).append(" ").append(metric.help);
      all.append("\n# TYPE ").append(name).append(" untyped\n").append(metric.samples);
    }
    return all;
  }

 private:
  void add(const Component& component, const FieldInfo& field, const Reading& reading) {
    const std::string name =
        "orbwatch_" + std::string(component.kind) + "_" + std::string(reading.name);
    Metric& metric = metrics_[name];
    metric.help = escaped(field.description);
    if (!reading.unit.empty()) metric.help += ", " + std::string(reading.unit);
    const std::string label =
        component.name.empty() ? "" : "{name=\"" + escaped(component.name) + "\"}";
    metric.samples += name + label + " " + number_text(reading.value) + "\n";
  }

  std::map<std::string, Metric> metrics_;
};

}  // namespace

std::string status_json(const StatusReport& report, const WebStatistics& web, double age) {
  auto components = status_readings(report);
  components.push_back(component_readings(kWeb, web, report.now));
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  const auto stamp = utc_text(report.stamp);
  all["stamp"] = stamp ? nlohmann::ordered_json(*stamp) : nlohmann::ordered_json();
  all["age"] = to_json(age);
  all.update(to_json(components));
  return all.dump();
}

std::string metrics_text(const StatusReport& report, const WebStatistics& web,
                         std::span<const InterfaceMetric> interfaces, std::string_view version) {
  Metrics metrics;
  for_each_component(report, [&](const Component& component, const auto& part) {
    metrics.add(component, part, report.now);
  });
  metrics.add(kWeb, web, report.now);
  for (const InterfaceMetric& figure : interfaces) metrics.add(figure);
  const std::string build =
      "# HELP orbwatch_build_info Version of orbwatchd\n# TYPE orbwatch_build_info gauge\n"
      "orbwatch_build_info{version=\"" +
      escaped(version) + "\"} 1\n";
  return build + metrics.text();
}

}  // namespace orbwatch::app::web
