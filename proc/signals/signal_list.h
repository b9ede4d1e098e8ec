/* The one list of process signals. Read by C++ (the struct, the Modbus rows, the manual) and by the
 * DDS IDL compiler, so it holds nothing but this macro.
 *
 * X(name, unit, scale, minimum, maximum, description)
 * name: snake_case; the struct member, the DDS member and the Modbus name.
 * scale: Modbus sends value / scale as a 32-bit integer. minimum, maximum: in the unit. */
#ifndef ORBWATCH_PROC_SIGNALS_SIGNAL_LIST_H
#define ORBWATCH_PROC_SIGNALS_SIGNAL_LIST_H

#define ORBWATCH_SIGNALS(X)                                                                       \
  X(hot_spot_yaw, "deg", 0.01, -180, 180, "Longitude of the hot spot's centroid, positive to +X") \
  X(hot_spot_pitch, "deg", 0.01, -90, 90, "Latitude of the hot spot's centroid, positive up")     \
  X(hot_spot_area, "msr", 0.001, 0, 12567, "Solid angle of the hot spot; 0 when there is none")   \
  X(hot_spot_peak_intensity, "%", 0.01, 0, 100, "Brightest pixel of the hot spot, of full scale") \
  X(hot_spot_mean_intensity, "%", 0.01, 0, 100, "Mean over the hot spot's area, of full scale")   \
  X(hot_spot_peak_temperature, "degC", 0.1, -273.15, 5000, "Hottest pixel, apparent temperature") \
  X(hot_spot_mean_temperature, "degC", 0.1, -273.15, 5000, "Mean apparent temperature of the area")

#endif
