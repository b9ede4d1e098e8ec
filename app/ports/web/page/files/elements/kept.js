// SPDX-License-Identifier: Apache-2.0
// Choices that the browser keeps for the next visit. One that keeps nothing forgets them.
export function kept(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

export function keep(name, value) {
  try {
    localStorage.setItem(name, value);
  } catch (error) {
    console.info(`${name} is not kept: ${error.message}`);
  }
}
