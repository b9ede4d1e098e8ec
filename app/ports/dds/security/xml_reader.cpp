#include "app/ports/dds/security/xml_reader.h"

#include <dds/ddsrt/xmlparser.h>

#include <cstdint>
#include <memory>

namespace orbwatch::app {
namespace {

/// What the parser's callbacks fill. They name an element by its place in `elements` plus one: 0 is
/// what the root stands in.
struct Reading {
  std::vector<XmlElement> elements;
  std::string error;
};

int on_open(void* argument, std::uintptr_t parent, std::uintptr_t* element, const char* name, int) {
  auto& elements = static_cast<Reading*>(argument)->elements;
  const std::string above = parent == 0 ? "" : elements[parent - 1].path + "/";
  elements.push_back({above + name, {}});
  *element = elements.size();
  return 1;
}

int on_attribute(void*, std::uintptr_t, const char*, const char*, int) { return 1; }

int on_text(void* argument, std::uintptr_t element, const char* text, int) {
  if (element > 0) static_cast<Reading*>(argument)->elements[element - 1].text += text;
  return 1;
}

int on_close(void*, std::uintptr_t, int) { return 1; }

void on_error(void* argument, const char* message, int line) {
  auto& error = static_cast<Reading*>(argument)->error;
  if (error.empty()) error = std::string(message) + " in line " + std::to_string(line);
}

struct ParserDeleter {
  void operator()(ddsrt_xmlp_state* parser) const { ddsrt_xmlp_free(parser); }
};

}  // namespace

Result<std::vector<XmlElement>> read_xml(const std::string& document) {
  constexpr ddsrt_xmlp_callbacks kCallbacks{on_open, on_attribute, on_text, on_close, on_error};
  Reading reading;
  const std::unique_ptr<ddsrt_xmlp_state, ParserDeleter> parser(
      ddsrt_xmlp_new_string(document.c_str(), &reading, &kCallbacks));
  if (ddsrt_xmlp_parse(parser.get()) < 0 || !reading.error.empty()) {
    return fail("is no XML: " + (reading.error.empty() ? "it ends too early" : reading.error));
  }
  if (reading.elements.empty()) return fail("is no XML: it has no element");
  return std::move(reading.elements);
}

}  // namespace orbwatch::app
