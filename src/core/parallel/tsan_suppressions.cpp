// Built into every program of a thread-sanitizer build. Memory that libtbb itself allocates and frees is handed between
// its threads by means the sanitizer cannot see; what our code does inside TBB tasks is not covered by this. liblcm's
// memq:// hands a message from publisher to receiver under locks of GLib, bare futexes that the sanitizer does not
// know: LcmBus says so for our handlers, but before they are called liblcm compares the message's channel. libOpenNI2
// and its file driver libOniFile call drivers, and are called by them, under locks of their own in both orders, hand
// memory between their threads, and at the end of the program unlock mutexes that they have not locked; what stands
// below one of their calls is not covered by this. FFmpeg's encoders and umockdev with libudev and GLib hand memory
// between threads of theirs.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libtbb.so\n"
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
