# Kernels that only the tests of devices use.
kernel(eight_lanes.comp)
