#include "../pairing/allocation_count.cpp"  // NOLINT: this program counts its own
