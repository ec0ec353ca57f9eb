// A board that is flashed by WebUSB, and its faults.
import { patient } from "./patience.js";

const PATIENCE = 10_000;  // ms of one transfer: the slowest erases of these boards take 4 s

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
