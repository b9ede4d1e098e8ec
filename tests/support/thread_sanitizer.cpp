// For test programs that decode pictures with OpenCV: Debian's build loads GDAL, which takes two
// locks of its own in both orders while it sets itself up, on one thread.
extern "C" const char* __tsan_default_suppressions() { return "deadlock:libgdal.so\n"; }
