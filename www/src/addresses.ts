// Under a figure's picture on paper stands where it is live: here.
for (const link of document.querySelectorAll<HTMLAnchorElement>('.address a')) link.textContent = link.href

export {}
