// Sums, products and order of normal floats for an Armv6-M core, in two thirds of the instructions that a compiler
// needs for float32.hpp. Rare cases go there with the original operands: zeros in products, denormals, infinities,
// NaNs, results out of range, ties. The same bits: tests/boards/soft_float runs both.
//
// Rounding: the significand is moved down with its highest lost bit into the carry. The addition of exponent and sign
// then adds the carry; the significand's own leading one, too, belongs to the exponent. Bits lost behind the highest
// matter for ties only. 24 bytes of stack, which tests/boards/image_check.py knows.
#include "hal/mcu/soft_float/float32.hpp"

namespace soft = fencepost::mcu::soft;

extern "C" {
soft::Bits fencepost_add(soft::Bits a, soft::Bits b);
soft::Bits fencepost_multiply(soft::Bits a, soft::Bits b);
[[gnu::used]] soft::Bits fencepost_add(soft::Bits a, soft::Bits b) { return soft::add(a, b); }
[[gnu::used]] soft::Bits fencepost_multiply(soft::Bits a, soft::Bits b) { return soft::multiply(a, b); }
}

// clang-format off
// Both end with what they pushed: two operands that nobody needs any more, and registers.
asm(R"(
  .syntax unified
  .macro leave
  add sp, #8
  pop {r4, r5, r6, pc}
  .endm

  .macro return_rounded head      @ exponent and sign; the first lost bit is the carry
  adcs r0, \head
  leave
  .endm
)");

// Ends with r0 = the significand, its leading one at bit `places` + 23 or left out. r3 = the shift of the smaller
// number. r6 = exponent and sign. Nothing was lost then if the shift is no more than 8.
asm(R"(
  .macro return_sum places
  lsls r4, r0, #(33 - \places)    @ all bits behind the first lost one
  beq 8f
  lsrs r0, r0, #\places
  return_rounded r6
8:
  lsrs r0, r0, #\places
  bcc 9f
  cmp r3, #8
  bhi add_slowly
  lsrs r4, r0, #1                 @ a tie, to even
9:
  return_rounded r6
  .endm
)");

// a - b, a + b
asm(R"(
  .section .text.__aeabi_fadd, "ax", %progbits
  .p2align 2
  .thumb
  .global __aeabi_fsub
  .type __aeabi_fsub, %function
  .thumb_func
__aeabi_fsub:
  movs r2, #1
  lsls r2, r2, #31
  eors r1, r2
  .global __aeabi_fadd
  .type __aeabi_fadd, %function
  .thumb_func
__aeabi_fadd:
  push {r0, r1, r4, r5, r6, lr}
  lsls r2, r0, #1
  lsls r3, r1, #1
  cmp r2, r3
  bcs 1f
  movs r4, r0                     @ the larger amount goes first
  movs r0, r1
  movs r1, r4
  movs r4, r2
  movs r2, r3
  movs r3, r4
1:
  lsrs r3, r3, #24
  beq add_nothing
  lsrs r2, r2, #24
  cmp r2, #255
  beq add_slowly
  subs r3, r2, r3                 @ how far the other has to be moved down
  lsrs r6, r0, #23
  lsls r6, r6, #23                @ sign and exponent
  movs r5, #1
  lsls r5, r5, #31
  movs r4, r0
  eors r4, r1
  bmi add_difference

  lsls r0, r0, #9                 @ leading one of the larger: bit 31, left out
  lsrs r0, r0, #1
  lsls r1, r1, #8
  orrs r1, r5
  lsrs r1, r3
  adds r0, r1
  bcs 2f
  bmi 3f
  return_sum 8
2:                                @ the sum's leading one: bit 32; at bit 31 there are two of them
  lsrs r4, r5, #8
  adds r6, r4
3:
  cmp r2, #254
  beq add_slowly
  lsrs r5, r5, #9                 @ the one left out goes one place down
  adds r6, r5
  return_sum 9

add_difference:
  lsls r0, r0, #9
  lsrs r0, r0, #1
  lsls r1, r1, #8
  orrs r1, r5
  lsrs r1, r3
  subs r0, r1
  bcc 4f
  return_sum 8
4:                                @ the leading one went: on to the next
  adds r0, r5
  beq 6f
  lsrs r6, r6, #31
  lsls r6, r6, #31
  lsrs r4, r0, #23
  bne 5f
  lsls r0, r0, #8
  subs r2, #8
5:
  subs r2, #1
  adds r0, r0
  bpl 5b
  subs r2, #1
  bmi add_slowly
  lsls r2, r2, #23
  orrs r6, r2
  return_sum 8

add_nothing:
  lsls r3, r1, #1
  bne add_slowly
  lsrs r2, r2, #24
  beq add_slowly
6:
  leave
add_slowly:
  pop {r0, r1, r4, r5, r6}
  bl fencepost_add
  pop {pc}
  .size __aeabi_fadd, . - __aeabi_fadd
)");

// a b: 24 by 24 bits from halves of 16 and 8, the upper 32 of 48 bits.
asm(R"(
  .section .text.__aeabi_fmul, "ax", %progbits
  .p2align 2
  .thumb
  .global __aeabi_fmul
  .type __aeabi_fmul, %function
  .thumb_func
__aeabi_fmul:
  push {r0, r1, r4, r5, r6, lr}
  lsls r2, r0, #1
  lsrs r2, r2, #24
  lsls r3, r1, #1
  lsrs r3, r3, #24
  movs r4, r0
  eors r4, r1
  subs r2, #1
  cmp r2, #253
  bhi multiply_slowly
  subs r3, #1
  cmp r3, #253
  bhi multiply_slowly
  adds r2, r3
  ldr r5, fractions
  ands r0, r5
  ands r1, r5
  adds r5, #1
  orrs r0, r5
  orrs r1, r5
  lsrs r3, r0, #8
  lsrs r6, r1, #8
  uxtb r1, r1
  muls r1, r0                     @ what b's lower bits add
  uxtb r0, r0
  muls r0, r6                     @ what a's lower and b's upper bits add, 8 bits further up
  muls r6, r3
  lsrs r1, r1, #8
  adds r0, r1
  lsrs r0, r0, #8
  adds r0, r6
  bmi 1f
  adds r0, r0
  subs r2, #1
1:
  subs r2, #125                   @ one less than the exponent: the leading one adds that
  cmp r2, #253
  bhi multiply_slowly
  lsls r2, r2, #23
  lsrs r4, r4, #31
  lsls r4, r4, #31
  orrs r2, r4
  lsls r4, r0, #25
  beq 2f
  lsrs r0, r0, #8
  return_rounded r2
2:
  lsrs r0, r0, #8
  bcs multiply_slowly             @ a tie, or a little more
  adds r0, r2
  leave
multiply_slowly:
  pop {r0, r1, r4, r5, r6}
  bl fencepost_multiply
  pop {pc}
  .p2align 2
fractions:
  .word 0x007fffff
  .size __aeabi_fmul, . - __aeabi_fmul
)");

// a < b, a > b. Two positive numbers are in the order of their bits; the larger one may be no number. A NaN
// is in no order, of two negative numbers the one with the smaller bits is larger, zeros are equal.
asm(R"(
  .macro negative_or_nan
  ldr r3, twice_infinity
  lsls r2, r0, #1
  cmp r2, r3
  bhi 8f
  lsls r2, r1, #1
  cmp r2, r3
  bhi 8f
  movs r2, r0
  ands r2, r1
  .endm

  .section .text.__aeabi_fcmplt, "ax", %progbits
  .p2align 2
  .thumb
  .global __aeabi_fcmpgt
  .type __aeabi_fcmpgt, %function
  .thumb_func
__aeabi_fcmpgt:
  movs r2, r0
  movs r0, r1
  movs r1, r2
  .global __aeabi_fcmplt
  .type __aeabi_fcmplt, %function
  .thumb_func
__aeabi_fcmplt:
  movs r2, r0
  orrs r2, r1
  bmi 1f
  cmp r0, r1
  bcs 8f
  ldr r3, twice_infinity
  lsrs r3, r3, #1
  cmp r1, r3
  bhi 8f
7:
  movs r0, #1
  bx lr
1:
  negative_or_nan
  bmi 2f
  cmp r0, #0                      @ one is negative: the first, and not both zero?
  bge 8f
  lsls r2, r0, #1
  orrs r2, r1
  bne 7b
8:
  movs r0, #0
  bx lr
2:
  cmp r0, r1
  bhi 7b
  movs r0, #0
  bx lr
  .size __aeabi_fcmplt, . - __aeabi_fcmplt
)");

// a <= b, a >= b
asm(R"(
  .section .text.__aeabi_fcmplt, "ax", %progbits
  .p2align 1
  .thumb
  .global __aeabi_fcmpge
  .type __aeabi_fcmpge, %function
  .thumb_func
__aeabi_fcmpge:
  movs r2, r0
  movs r0, r1
  movs r1, r2
  .global __aeabi_fcmple
  .type __aeabi_fcmple, %function
  .thumb_func
__aeabi_fcmple:
  movs r2, r0
  orrs r2, r1
  bmi 1f
  cmp r0, r1
  bhi 8f
  ldr r3, twice_infinity
  lsrs r3, r3, #1
  cmp r1, r3
  bhi 8f
7:
  movs r0, #1
  bx lr
1:
  negative_or_nan
  bmi 2f
  cmp r0, #0                      @ one is negative: the first, or both are zero?
  blt 7b
  lsls r2, r1, #1
  orrs r2, r0
  beq 7b
8:
  movs r0, #0
  bx lr
2:
  cmp r0, r1
  bcs 7b
  movs r0, #0
  bx lr
  .p2align 2
twice_infinity:
  .word 0xff000000
  .size __aeabi_fcmple, . - __aeabi_fcmple
)");
// clang-format on
