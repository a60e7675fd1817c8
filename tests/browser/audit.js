// What a page looks like to those who check it: an object of functions, given to the page by
// audit.py. Each returns what is wrong, in words.
({
  // Text whose contrast to what lies behind it is below 4.5, or 3 where it is large (WCAG 1.4.3).
  faint() {
    const pixel = Object.assign(document.createElement("canvas"), { width: 1, height: 1 });
    const painter = pixel.getContext("2d", { willReadFrequently: true });
    const read = (colour) => {
      painter.clearRect(0, 0, 1, 1);
      painter.fillStyle = colour;
      painter.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = painter.getImageData(0, 0, 1, 1).data;
      return [r, g, b, a / 255];
    };
    const over = ([r, g, b, a], under) => [r, g, b].map((c, k) => c * a + under[k] * (1 - a)).concat(1);
    const linear = (c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
    const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    const contrast = (a, b) => {
      const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
      return (high + 0.05) / (low + 0.05);
    };
    const inside = (box, x, y) => box.left <= x && x <= box.right && box.top <= y && y <= box.bottom;
    // Colours from the element upwards, until one that hides all beneath it.
    const behind = (element, x, y) => {
      const layers = [];
      for (let one = element; one; one = one.parentElement) {
        if (one instanceof SVGElement && one.parentElement instanceof SVGElement) {
          const below = [...one.parentElement.children];
          for (const shape of below.slice(0, below.indexOf(one)).reverse()) {
            if (!/^(rect|circle|path|polygon)$/.test(shape.tagName)) continue;
            if (inside(shape.getBoundingClientRect(), x, y)) layers.push(read(getComputedStyle(shape).fill));
          }
        } else {
          layers.push(read(getComputedStyle(one).backgroundColor));
        }
        if (layers.some((layer) => layer[3] > 0.99)) break;
      }
      return layers.reverse().reduce((under, layer) => over(layer, under), [...read("Canvas")]);
    };
    const opacity = (element) => {
      let found = 1;
      for (let one = element; one; one = one.parentElement) found *= Number(getComputedStyle(one).opacity);
      return found;
    };
    const wrong = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const text = node.nodeValue.trim();
      const element = node.parentElement;
      if (!text || element.closest("script, style, noscript, [disabled], [aria-disabled=true], option")) continue;
      if (!element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      const box = range.getBoundingClientRect();
      if (box.width < 3 || box.height < 3) continue; // only for those who hear the page
      const hider = element.closest(".unseen");
      if (hider && hider.getBoundingClientRect().width < 3) continue;
      const style = getComputedStyle(element);
      const x = box.left + box.width / 2;
      const y = box.top + box.height / 2;
      const ground = behind(element, x, y);
      const ink = read(element instanceof SVGElement ? style.fill : style.color);
      ink[3] *= opacity(element);
      const size = parseFloat(style.fontSize);
      const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
      const found = contrast(over(ink, ground), ground);
      if (found < (large ? 3 : 4.5) - 0.005) wrong.push(`${found.toFixed(2)}: ${element.tagName}.${element.className?.baseVal ?? element.className} ${text.slice(0, 40)}`);
    }
    return wrong;
  },

  // What is pressed, and is smaller than a finger (44 px, WCAG 2.5.5); words within a sentence, which
  // that leaves out, may be 24 px (WCAG 2.5.8).
  small() {
    const wrong = [];
    const spoken = (one) => {
      const sentence = one.closest("p, td, dd, li");
      return sentence !== null && sentence.textContent.trim() !== one.textContent.trim();
    };
    for (const one of document.querySelectorAll("button, a[href], input, textarea, select, summary, [role=slider], [role=tab], [role=treeitem]")) {
      const box = one.getBoundingClientRect();
      if (!one.checkVisibility({ visibilityProperty: true, opacityProperty: true }) || box.width < 3) continue;
      if (one.closest(".skips")) continue;
      const least = spoken(one) ? 24 : 44;
      const label = one.closest("label")?.getBoundingClientRect();
      const [width, height] = [Math.max(box.width, label?.width ?? 0), Math.max(box.height, label?.height ?? 0)];
      if (width < least - 0.5 || height < least - 0.5) wrong.push(`${one.tagName}.${one.className} "${(one.ariaLabel ?? one.textContent).slice(0, 30)}" ${width.toFixed(0)}x${height.toFixed(0)} in ${one.parentElement.outerHTML.slice(0, 200)}`);
    }
    return wrong;
  },

  // Whatever makes the page wider than the window.
  wide() {
    const page = document.scrollingElement;
    if (page.scrollWidth <= page.clientWidth) return [];
    const beyond = [...document.body.querySelectorAll("*")].filter((one) => one.getBoundingClientRect().right > page.clientWidth + 1);
    return [`${page.scrollWidth} > ${page.clientWidth}`, ...beyond.slice(0, 5).map((one) => `${one.tagName}#${one.id}.${one.className}`)];
  },

  // What moves by itself.
  moving() {
    const moving = document.getAnimations().filter((one) => one.playState === "running" && one.effect.getComputedTiming().duration > 50);
    return moving.map((one) => `${one.effect.target?.tagName}.${one.effect.target?.className} ${one.animationName ?? one.transitionProperty}`);
  },
})
