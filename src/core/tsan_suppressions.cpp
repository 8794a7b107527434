// Built into every program of a thread-sanitizer build. Memory that libtbb itself allocates and frees is handed between
// its threads by means the sanitizer cannot see; what our code does inside TBB tasks is not covered by this. libgdal,
// which OpenCV's image codecs load, takes two locks of its own in both orders while it starts. liblcm's memq:// hands a
// message from publisher to receiver under locks of GLib, bare futexes that the sanitizer does not know: LcmBus says so
// for our handlers, but before they are called liblcm compares the message's channel. libOpenNI2 unlocks mutexes that it
// has not locked when the program ends.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libtbb.so\n"
         "deadlock:libgdal.so\n"
         "race:g_str_equal\n"
         "mutex:libOpenNI2.so\n";
}
