// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/doctor_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/text_table.h"

namespace orbwatch::app::cli::doctor {
namespace {

std::string counted(std::ptrdiff_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string name_of(Level level) { return std::string(word_for(kLevels, level)); }

}  // namespace

Level worst(const Diagnoses& diagnoses) {
  const auto found = std::ranges::max_element(diagnoses, {}, &Diagnosis::level);
  return found == diagnoses.end() ? Level::Ok : found->level;
}

std::string summary(const Diagnoses& diagnoses) {
  const auto count = [&](Level level) {
    return std::ranges::count(diagnoses, level, &Diagnosis::level);
  };
  return counted(count(Level::Fault), "fault") + ", " + counted(count(Level::Warning), "warning");
}

std::string doctor_table(const Diagnoses& diagnoses) {
  std::vector<Fields> records;
  records.reserve(diagnoses.size());
  for (const Diagnosis& diagnosis : diagnoses) {
    // The last column is not padded.
    const std::string remedy = diagnosis.remedy.empty() ? "" : ". Remedy: " + diagnosis.remedy;
    records.push_back({{"level", name_of(diagnosis.level)},
                       {"check", diagnosis.check},
                       {"finding", diagnosis.text + remedy}});
  }
  return record_lines(records) + "\n" + summary(diagnoses) + "\n";
}

std::string doctor_json(const Diagnoses& diagnoses) {
  using Json = nlohmann::ordered_json;
  Json checks = Json::array();
  for (const Diagnosis& diagnosis : diagnoses) {
    checks.push_back({{"check", diagnosis.check},
                      {"level", name_of(diagnosis.level)},
                      {"text", diagnosis.text},
                      {"remedy", diagnosis.remedy}});
  }
  const Json all{{"worst", name_of(worst(diagnoses))}, {"checks", std::move(checks)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orbwatch::app::cli::doctor
