/* The one list of what is measured in a region of interest. Read by C++ (the struct, the Modbus
 * rows, the manual) and by the DDS IDL compiler, so it holds nothing but macros.
 *
 * X(name, unit, scale, minimum, maximum, description)
 * name: snake_case; the struct member, the DDS member and the Modbus name.
 * scale: Modbus sends value / scale as a 32-bit integer. minimum, maximum: in the unit. */
#ifndef ORBWATCH_PROC_SIGNALS_SIGNAL_LIST_H
#define ORBWATCH_PROC_SIGNALS_SIGNAL_LIST_H

/* What one frame set says. Angles are those of directions from the ball's centre, lengths in mm
 * those on the machine's known geometry; without it nothing in mm is valid. */
#define ORBWATCH_FRAME_SIGNALS(X)                                                                 \
  X(hot_spot_present, "", 1, 0, 1, "1: there is a hot spot; 0: none, and areas are 0")            \
  X(hot_spot_pixels, "px", 0.01, 0, 16777216, "Area of the hot spot in the measured view")        \
  X(hot_spot_solid_angle, "msr", 0.001, 0, 12567, "Solid angle of the hot spot")                  \
  X(hot_spot_area, "mm2", 0.01, 0, 1000000, "Area of the hot spot on the machine's surface")      \
  X(hot_spot_length, "mm", 0.001, 0, 5000, "Long axis of the ellipse with its second moments")    \
  X(hot_spot_width, "mm", 0.001, 0, 5000, "Axis of that ellipse across the long one")             \
  X(hot_spot_width_error, "mm", 0.001, -5000, 5000, "Width minus its set-point")                  \
  X(hot_spot_orientation_xy, "deg", 0.1, -90, 90,                                                 \
    "Long axis on the machine's X and Y: 0 along X, positive from +X towards +Y; none if round")  \
  X(hot_spot_length_angle, "deg", 0.001, 0, 180, "Long axis as an angle seen from the ball")      \
  X(hot_spot_width_angle, "deg", 0.001, 0, 180, "Axis across the long one, as an angle")          \
  X(hot_spot_orientation, "deg", 0.1, -90, 90,                                                    \
    "Long axis as seen from the ball: 0 horizontal, positive when its right end is up")           \
  X(hot_spot_yaw, "deg", 0.01, -180, 180, "Longitude of the hot spot's centroid, positive to +X") \
  X(hot_spot_pitch, "deg", 0.01, -90, 90, "Latitude of the hot spot's centroid, positive up")     \
  X(hot_spot_x, "mm", 0.01, -100000, 100000, "Centroid on the machine's surface, machine frame")  \
  X(hot_spot_y, "mm", 0.01, -100000, 100000, "Centroid on the machine's surface, machine frame")  \
  X(hot_spot_z, "mm", 0.01, -100000, 100000, "Centroid on the machine's surface, machine frame")  \
  X(hot_spot_mean_intensity, "%", 0.01, 0, 100, "Mean over the hot spot, of full scale")          \
  X(hot_spot_peak_intensity, "%", 0.01, 0, 100, "Brightest pixel of the hot spot, of full scale") \
  X(hot_spot_saturated, "%", 0.01, 0, 100,                                                        \
    "Share of the hot spot's pixels that are at full scale")                                      \
  X(hot_spot_mean_temperature, "degC", 0.1, -273.15, 5000,                                        \
    "Mean temperature of the hot spot, by solid angle; apparent unless calibrated")               \
  X(hot_spot_peak_temperature, "degC", 0.1, -273.15, 5000,                                        \
    "Hottest pixel; apparent unless calibrated")                                                  \
  X(hot_spot_cooling_rate, "K/s", 1, -1000000, 1000000,                                           \
    "Mean fall of temperature, since the frame set before, of what has left the hot spot since")  \
  X(plume_area, "msr", 0.001, 0, 12567,                                                           \
    "Solid angle above the plume threshold around the hot spot, without the hot spot")            \
  X(spatter_count, "", 1, 0, 10000, "Sparks in this frame set")                                   \
  X(spatter_rate, "1/s", 0.1, 0, 10000, "New sparks in the last second")                          \
  X(spatter_speed, "deg/s", 0.1, 0, 36000, "Mean speed of the last second's sparks")              \
  X(spatter_speed_0, "", 1, 0, 10000, "Sparks of the last second below 50 deg/s")                 \
  X(spatter_speed_50, "", 1, 0, 10000, "Sparks of the last second from 50 to 100 deg/s")          \
  X(spatter_speed_100, "", 1, 0, 10000, "Sparks of the last second from 100 to 150 deg/s")        \
  X(spatter_speed_150, "", 1, 0, 10000, "Sparks of the last second from 150 to 200 deg/s")        \
  X(spatter_speed_200, "", 1, 0, 10000, "Sparks of the last second from 200 to 250 deg/s")        \
  X(spatter_speed_250, "", 1, 0, 10000, "Sparks of the last second from 250 to 300 deg/s")        \
  X(spatter_speed_300, "", 1, 0, 10000, "Sparks of the last second from 300 to 350 deg/s")        \
  X(spatter_speed_350, "", 1, 0, 10000, "Sparks of the last second from 350 deg/s on")

/* The signals above of which mean, deviation and trend over the last second are signals too:
 * Y(X, name, unit, scale, minimum, maximum); X is passed through. */
#define ORBWATCH_MAIN_SIGNALS(Y, X)                           \
  Y(X, hot_spot_area, "mm2", 0.01, 0, 1000000)                \
  Y(X, hot_spot_width, "mm", 0.001, 0, 5000)                  \
  Y(X, hot_spot_mean_intensity, "%", 0.01, 0, 100)            \
  Y(X, hot_spot_mean_temperature, "degC", 0.1, -273.15, 5000) \
  Y(X, hot_spot_peak_temperature, "degC", 0.1, -273.15, 5000) \
  Y(X, spatter_rate, "1/s", 0.1, 0, 10000)

#define ORBWATCH_STATISTICS(X, name, unit, scale, minimum, maximum)                       \
  X(name##_mean, unit, scale, minimum, maximum, "Mean of " #name " over the last second") \
  X(name##_deviation, unit, scale, 0, (maximum) - (minimum),                              \
    "Standard deviation of " #name " over the last second")                               \
  X(name##_trend, unit "/s", scale, -10 * (maximum), 10 * (maximum),                      \
    "Least-squares slope of " #name " over the last second")

#define ORBWATCH_SIGNALS(X) ORBWATCH_FRAME_SIGNALS(X) ORBWATCH_MAIN_SIGNALS(ORBWATCH_STATISTICS, X)

#endif
