// Linked into every executable that is built with the address sanitizer (cmake/Options.cmake): what other libraries
// keep until the process ends, which a check for leaks must not take for ours. CLN keeps 26 bytes of its constants,
// Fontconfig some of its patterns.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln\nleak:libfontconfig\n"; }
