// Suppressions for every program of a thread-sanitizer build. libtbb hands its own memory between threads in ways that
// the sanitizer does not see; what our code does in TBB tasks is still checked. libgdal, which OpenCV's image codecs
// load, takes two of its locks in both orders at start-up. liblcm's memq:// hands messages over under GLib's locks,
// bare futexes that the sanitizer does not know; LcmBus states that order for our handlers, but liblcm compares the
// channel before calling them. libOpenNI2 and its file driver libOniFile call drivers and are called by them under
// their own locks in both orders, hand memory between threads, and unlock mutexes that they have not locked at the end
// of the program; code below their calls is not checked. FFmpeg's encoders, and umockdev with libudev and GLib, hand
// memory between their own threads.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libtbb.so\n"
         "deadlock:libgdal.so\n"
         "race:g_str_equal\n"
         "mutex:libOpenNI2.so\n"
         "deadlock:libOpenNI2.so\n"
         "race:libOpenNI2.so\n"
         "race:libOniFile.so\n"
         "race:libavutil.so\n"
         "race:libavcodec.so\n"
         "race:libumockdev.so\n"
         "race:libudev.so\n";
}
