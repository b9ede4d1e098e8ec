// SPDX-License-Identifier: Apache-2.0
/* The list of what is measured in a region of interest, one line per signal. signals.h turns it
 * into the struct Signals and the table kSignals; interfaces and manuals walk that table.
 *
 * X(name, title, unit, scale, minimum, maximum, requirements, description)
 * name: snake_case; the struct member and the name at every interface. title: the name for people.
 * scale: resolution in the unit, for interfaces that send whole numbers (value / scale).
 * minimum, maximum: in the unit.
 * requirements: of enum Requires, joined by |; without them the signal never has a value. */
#ifndef ORBWATCH_PROC_SIGNALS_SIGNAL_LIST_H
#define ORBWATCH_PROC_SIGNALS_SIGNAL_LIST_H

/* Of one frame set. Angles are between directions from the ball's centre; lengths in mm lie on the
 * machine's surfaces, as the scene describes them. */
#define ORBWATCH_FRAME_SIGNALS(X)                                                                  \
  X(hot_spot_present, "Hot spot present", "", 1, 0, 1, Nothing,                                    \
    "1: there is a hot spot; 0: none, and areas are 0")                                            \
  X(hot_spot_pixels, "Hot spot area in the view", "px", 0.01, 0, 16777216, Nothing,                \
    "Area of the hot spot in the measured view")                                                   \
  X(hot_spot_solid_angle, "Hot spot solid angle", "msr", 0.001, 0, 12567, Nothing,                 \
    "Solid angle of the hot spot")                                                                 \
  X(hot_spot_area, "Hot spot area", "mm2", 0.01, 0, 1000000, Scene,                                \
    "Area of the hot spot on the machine's surface")                                               \
  X(hot_spot_length, "Hot spot length", "mm", 0.001, 0, 5000, Scene,                               \
    "Long axis of the ellipse with its second moments")                                            \
  X(hot_spot_width, "Hot spot width", "mm", 0.001, 0, 5000, Scene,                                 \
    "Axis of that ellipse across the long one")                                                    \
  X(hot_spot_width_error, "Hot spot width error", "mm", 0.001, -5000, 5000, Scene | WidthSetPoint, \
    "Width minus its set-point")                                                                   \
  X(hot_spot_orientation_xy, "Hot spot orientation in the machine", "deg", 0.1, -90, 90, Scene,    \
    "Long axis on the machine's X and Y: 0 along X, positive from +X towards +Y; none if round")   \
  X(hot_spot_length_angle, "Hot spot length as an angle", "deg", 0.001, 0, 180, Nothing,           \
    "Long axis as an angle seen from the ball")                                                    \
  X(hot_spot_width_angle, "Hot spot width as an angle", "deg", 0.001, 0, 180, Nothing,             \
    "Axis across the long one, as an angle")                                                       \
  X(hot_spot_orientation, "Hot spot orientation from the ball", "deg", 0.1, -90, 90, Nothing,      \
    "Long axis as seen from the ball: 0 horizontal, positive when its right end is up")            \
  X(hot_spot_yaw, "Hot spot yaw", "deg", 0.01, -180, 180, Nothing,                                 \
    "Longitude of the hot spot's centroid, positive to +X")                                        \
  X(hot_spot_pitch, "Hot spot pitch", "deg", 0.01, -90, 90, Nothing,                               \
    "Latitude of the hot spot's centroid, positive up")                                            \
  X(hot_spot_x, "Hot spot X", "mm", 0.01, -100000, 100000, Scene,                                  \
    "Centroid on the machine's surface, machine frame")                                            \
  X(hot_spot_y, "Hot spot Y", "mm", 0.01, -100000, 100000, Scene,                                  \
    "Centroid on the machine's surface, machine frame")                                            \
  X(hot_spot_z, "Hot spot Z", "mm", 0.01, -100000, 100000, Scene,                                  \
    "Centroid on the machine's surface, machine frame")                                            \
  X(hot_spot_mean_intensity, "Hot spot mean intensity", "%", 0.01, 0, 100, Nothing,                \
    "Mean over the hot spot, of full scale")                                                       \
  X(hot_spot_peak_intensity, "Hot spot peak intensity", "%", 0.01, 0, 100, Nothing,                \
    "Brightest pixel of the hot spot, of full scale")                                              \
  X(hot_spot_saturated, "Hot spot saturation", "%", 0.01, 0, 100, Nothing,                         \
    "Share of the hot spot's pixels that are at full scale")                                       \
  X(hot_spot_mean_temperature, "Hot spot mean temperature", "degC", 0.1, -273.15, 5000,            \
    RadiometricCamera,                                                                             \
    "Mean temperature of the hot spot, by solid angle; apparent unless calibrated")                \
  X(hot_spot_peak_temperature, "Hot spot peak temperature", "degC", 0.1, -273.15, 5000,            \
    RadiometricCamera, "Hottest pixel; apparent unless calibrated")                                \
  X(hot_spot_cooling_rate, "Cooling rate", "K/s", 1, -1000000, 1000000, RadiometricCamera,         \
    "Mean fall of temperature, since the previous frame set, of the surface that left the hot "    \
    "spot since then")                                                                             \
  X(plume_area, "Plume area", "msr", 0.001, 0, 12567, PlumeThreshold,                              \
    "Solid angle above the plume threshold around the hot spot, without the hot spot")             \
  X(spatter_count, "Spatter count", "", 1, 0, 10000, SpatterThreshold, "Sparks in this frame set") \
  X(spatter_rate, "Spatter rate", "1/s", 0.1, 0, 10000, SpatterThreshold,                          \
    "New sparks in the last second")                                                               \
  X(spatter_speed, "Spatter speed", "deg/s", 0.1, 0, 36000, SpatterThreshold,                      \
    "Mean speed of the last second's sparks")                                                      \
  X(spatter_speed_0, "Spatter in speed class 1 of 8", "", 1, 0, 10000, SpatterThreshold,           \
    "Sparks of the last second below 50 deg/s")                                                    \
  X(spatter_speed_50, "Spatter in speed class 2 of 8", "", 1, 0, 10000, SpatterThreshold,          \
    "Sparks of the last second from 50 to 100 deg/s")                                              \
  X(spatter_speed_100, "Spatter in speed class 3 of 8", "", 1, 0, 10000, SpatterThreshold,         \
    "Sparks of the last second from 100 to 150 deg/s")                                             \
  X(spatter_speed_150, "Spatter in speed class 4 of 8", "", 1, 0, 10000, SpatterThreshold,         \
    "Sparks of the last second from 150 to 200 deg/s")                                             \
  X(spatter_speed_200, "Spatter in speed class 5 of 8", "", 1, 0, 10000, SpatterThreshold,         \
    "Sparks of the last second from 200 to 250 deg/s")                                             \
  X(spatter_speed_250, "Spatter in speed class 6 of 8", "", 1, 0, 10000, SpatterThreshold,         \
    "Sparks of the last second from 250 to 300 deg/s")                                             \
  X(spatter_speed_300, "Spatter in speed class 7 of 8", "", 1, 0, 10000, SpatterThreshold,         \
    "Sparks of the last second from 300 to 350 deg/s")                                             \
  X(spatter_speed_350, "Spatter in speed class 8 of 8", "", 1, 0, 10000, SpatterThreshold,         \
    "Sparks of the last second from 350 deg/s on")

/* Those whose mean, deviation and trend over the last second are signals, too:
 * Y(X, name, title, unit, scale, minimum, maximum, requirements); X is passed through. */
#define ORBWATCH_MAIN_SIGNALS(Y, X)                                                        \
  Y(X, hot_spot_area, "Hot spot area", "mm2", 0.01, 0, 1000000, Scene)                     \
  Y(X, hot_spot_width, "Hot spot width", "mm", 0.001, 0, 5000, Scene)                      \
  Y(X, hot_spot_mean_intensity, "Hot spot mean intensity", "%", 0.01, 0, 100, Nothing)     \
  Y(X, hot_spot_mean_temperature, "Hot spot mean temperature", "degC", 0.1, -273.15, 5000, \
    RadiometricCamera)                                                                     \
  Y(X, hot_spot_peak_temperature, "Hot spot peak temperature", "degC", 0.1, -273.15, 5000, \
    RadiometricCamera)                                                                     \
  Y(X, spatter_rate, "Spatter rate", "1/s", 0.1, 0, 10000, SpatterThreshold)

#define ORBWATCH_STATISTICS(X, name, title, unit, scale, minimum, maximum, requirements)        \
  X(name##_mean, title ", mean", unit, scale, minimum, maximum, requirements,                   \
    "Mean of " #name " over the last second")                                                   \
  X(name##_deviation, title ", deviation", unit, scale, 0, (maximum) - (minimum), requirements, \
    "Standard deviation of " #name " over the last second")                                     \
  X(name##_trend, title ", trend", unit "/s", scale, -10 * (maximum), 10 * (maximum),           \
    requirements, "Least-squares slope of " #name " over the last second")

/* Appended since numbers of signals are fixed: PLCs and controllers know them. */
#define ORBWATCH_LATER_SIGNALS(X)                                                                  \
  X(hot_spot_confidence, "Hot spot confidence", "%", 0.1, 0, 100, Nothing,                         \
    "Confidence that the hot spot is the previous one: seen in the last frame sets, of its usual " \
    "size, no similar one")                                                                        \
  X(spatter_untracked, "Spatter not tracked", "", 1, 0, 10000, SpatterThreshold,                   \
    "Sparks of the last second beyond the tracking limit, which spatter_rate does not count")

#define ORBWATCH_SIGNALS(X) \
  ORBWATCH_FRAME_SIGNALS(X) ORBWATCH_MAIN_SIGNALS(ORBWATCH_STATISTICS, X) ORBWATCH_LATER_SIGNALS(X)

#endif
