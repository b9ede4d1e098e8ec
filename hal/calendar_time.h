// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <ctime>

/// UTC by the calendar of the C library's functions, counted in 64 bit: gmtime_r() and timegm() end
/// in January 2038 where time_t has 32 bit, as on armhf of Debian 12. All reentrant.
namespace orbwatch::hal {

inline std::tm calendar_time(std::chrono::sys_seconds moment) {
  const auto day = std::chrono::floor<std::chrono::days>(moment);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss time(moment - day);
  std::tm fields{};
  fields.tm_year = static_cast<int>(date.year()) - 1900;
  fields.tm_mon = static_cast<int>(static_cast<unsigned>(date.month())) - 1;
  fields.tm_mday = static_cast<int>(static_cast<unsigned>(date.day()));
  fields.tm_hour = static_cast<int>(time.hours().count());
  fields.tm_min = static_cast<int>(time.minutes().count());
  fields.tm_sec = static_cast<int>(time.seconds().count());
  fields.tm_wday = static_cast<int>(std::chrono::weekday(day).c_encoding());
  fields.tm_yday = static_cast<int>(
      (day - std::chrono::sys_days(date.year() / std::chrono::January / 1)).count());
  return fields;
}

/// The moment of year, month, day, hour, minute and second; values beyond their ranges are carried
/// over.
inline std::chrono::sys_seconds moment_of(const std::tm& fields) {
  const auto month = std::chrono::year(fields.tm_year + 1900) / std::chrono::January +
                     std::chrono::months(fields.tm_mon);
  return std::chrono::sys_days(month / 1) + std::chrono::days(fields.tm_mday - 1) +
         std::chrono::hours(fields.tm_hour) + std::chrono::minutes(fields.tm_min) +
         std::chrono::seconds(fields.tm_sec);
}

}  // namespace orbwatch::hal
