// A board that is flashed by WebUSB, and its faults.
import { patient } from "./patience.js";

/** ms: the slowest sector is erased in 4,000 (datasheet of the STM32F405). */
export const PATIENCE = 10_000;

/** The one that the user chooses of `devices`, [{ vendorId, productId }]. */
export const choose = async (usb, devices) => patient(await usb.requestDevice({ filters: devices }), PATIENCE);

/** The board refused: `command`, `reason`. */
export class Refused extends Error {
  constructor(command, reason) {
    super(`${command}: ${reason}`);
    Object.assign(this, { command, reason });
  }
}

/** The board has other bytes than were written. */
export class Differs extends Error {
  constructor(address) {
    super(`differs at ${address}`);
    this.address = address;
  }
}
