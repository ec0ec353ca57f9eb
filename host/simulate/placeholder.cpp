namespace fencepost {}
