// The bytes of a CAN frame, as emulated wheels count them; there is no CAN bus here.
#pragma once

#define CAN_EFF_FLAG 0x80000000U

struct can_frame {
  unsigned can_id;
  unsigned char can_dlc;
  unsigned char reserved[3];
  unsigned char data[8];
};
