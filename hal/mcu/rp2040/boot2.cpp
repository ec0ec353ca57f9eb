// The second stage of booting: the first 256 bytes of the flash (RP2040 datasheet 2.8.1.3.1). The boot ROM checks their
// CRC, copies them to memory and calls them; they have to make the rest of the flash readable.
//
// The plain read command, 03h, which every flash chip knows, at a quarter of the core's clock (4.10.13: SSI). It is
// slow; nothing runs from the flash but the loader behind this (loader.cpp).

// Registers of the SSI at 0x18000000 (4.10.13): 0x00 CTRLR0, 0x04 CTRLR1, 0x08 SSIENR, 0x14 BAUDR, 0xf4 SPI_CTRLR0.
asm(R"(
    .section .boot2, "ax"
    .syntax unified
    .thumb
    .thumb_func
    .global fencepost_boot2
fencepost_boot2:
    ldr r3, =0x18000000
    movs r0, #0
    str r0, [r3, #0x08]     // off while it is set up
    str r0, [r3, #0x04]     // one word a read
    movs r0, #4
    str r0, [r3, #0x14]     // core's clock / 4: 31 MHz, 03h is good for 50 at least
    ldr r0, =0x001f0300     // 32-bit words, one data line, read after sending command and address
    str r0, [r3, #0x00]
    ldr r0, =0x03000218     // command 03h, 8 bits of command, 24 of address, one line
    movs r1, #0xf4
    str r0, [r3, r1]
    movs r0, #1
    str r0, [r3, #0x08]     // on: the flash appears at 0x10000000
    ldr r1, =0x10000100     // the vectors lie behind this
    ldr r0, =0xe000ed08     // VTOR (Armv6-M B3.2.5)
    str r1, [r0]
    ldr r0, [r1, #0]
    msr msp, r0
    ldr r0, [r1, #4]
    bx r0
    .ltorg
    .space 252 - (. - fencepost_boot2)
    .word 0xbb33ec04        // CRC-32/MPEG-2 of all before; toolchain/uf2.py says the right one when it is wrong
    .text
)");
