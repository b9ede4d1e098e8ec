// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/metrics_text.h"

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <map>
#include <utility>
#include <vector>

#include "app/model/status/readings.h"

namespace orbwatch::app::web {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;

/// Figures by metric name. Made at each scrape from the model, which already has the counts: a
/// prometheus::Registry would duplicate every figure.
class Families {
 public:
  explicit Families(hal::TimePoint now) : now_(now) {}

  template <class Part>
  void add(const Component& component, const Part& part) {
    for_each_field(std::type_identity<Part>{}, [&](const auto& field) {
      add(component, field, reading_of(field, std::invoke(field.get, part), now_));
    });
  }
  void add(const InterfaceMetric& figure) {
    const FieldInfo& field = figure.field;
    add(figure.component, field, {field.name, figure.value, field.unit});
  }

  std::vector<MetricFamily> take() {
    std::vector<MetricFamily> all;
    for (auto& [name, family] : families_) all.push_back(std::move(family));
    return all;
  }

 private:
  void add(const Component& component, const FieldInfo& field, const Reading& reading) {
    const std::string name =
        "orbwatch_" + std::string(component.kind) + "_" + std::string(reading.name);
    MetricFamily& family = families_[name];
    family.name = name;
    family.help = field.description;
    if (!reading.unit.empty()) family.help += ", " + std::string(reading.unit);
    ClientMetric& metric = family.metric.emplace_back();
    if (!component.name.empty()) metric.label.push_back({"name", std::string(component.name)});
    metric.untyped.value = reading.value;
    if (is_text(reading)) {
      metric.label.push_back({"text", std::string(reading.text)});
      metric.untyped.value = 1;
    }
  }

  const hal::TimePoint now_;
  std::map<std::string, MetricFamily> families_;
};

MetricFamily build_info(std::string_view version) {
  MetricFamily family{"orbwatch_build_info",
                      "Version of orbwatchd",
                      prometheus::MetricType::Gauge,
                      {ClientMetric{}}};
  family.metric.front().label.push_back({"version", std::string(version)});
  family.metric.front().gauge.value = 1;
  return family;
}

}  // namespace

std::string metrics_text(const StatusReport& report, const WebStatistics& web,
                         std::span<const InterfaceMetric> interfaces, std::string_view version) {
  Families families(report.now);
  for_each_component(
      report, [&](const Component& component, const auto& part) { families.add(component, part); });
  families.add(kWebComponent, web);
  for (const InterfaceMetric& figure : interfaces) families.add(figure);
  auto all = families.take();
  all.push_back(build_info(version));
  return prometheus::TextSerializer().Serialize(all);
}

}  // namespace orbwatch::app::web
