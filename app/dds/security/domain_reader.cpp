#include "app/dds/security/domain_reader.h"

#include <charconv>
#include <limits>

namespace orbwatch::app {
namespace {

constexpr int kNoDomain = -1;

int number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? value : kNoDomain;
}

}  // namespace

void read_domain(const XmlElement& element, const std::string& rule,
                 std::vector<DomainRange>& domains) {
  const std::string place = rule + "/domains/";
  if (!element.path.starts_with(place)) return;
  const std::string what = element.path.substr(place.size());
  const int value = number(element.text);
  if (what == "id") domains.push_back({value, value});
  // Without an end a range has none.
  if (what == "id_range") domains.push_back({0, std::numeric_limits<int>::max()});
  if (what == "id_range/min") domains.back().first = value;
  if (what == "id_range/max") domains.back().last = value;
}

}  // namespace orbwatch::app
