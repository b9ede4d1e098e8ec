#pragma once

#include <string>
#include <string_view>

namespace orbwatch::app {

/// Whether the topic of that name carries JPEG pictures.
bool is_compressed_topic(std::string_view topic);
/// Whether the topic of that name carries the process state.
bool is_process_state_topic(std::string_view topic);

/// The DDS name of a topic given with or without "rt/" or a leading "/".
std::string full_topic(std::string_view topic);

/// The file name, without extension, of the newest image of `topic`: "front" of
/// rt/<prefix>/front/image_raw, "front-radiometric" of rt/<prefix>/front/radiometric/image_raw,
/// "front-compressed" of rt/<prefix>/front/image_raw/compressed. Whatever the topic, it holds
/// letters, digits, '_', '-' and '.' only and never starts with a dot.
std::string file_stem(std::string_view topic, std::string_view prefix);

}  // namespace orbwatch::app
