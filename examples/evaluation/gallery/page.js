"use strict";

// A press on the head of a column sorts the table by it, another the other way round. Cells without a value go last.
for (const head of document.querySelectorAll("thead th")) {
    head.querySelector("button").addEventListener("click", () => {
        const column = [...head.parentNode.children].indexOf(head);
        const body = head.closest("table").tBodies[0];
        const sign = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
        for (const other of head.parentNode.children) {
            other.removeAttribute("aria-sort");
        }
        head.setAttribute("aria-sort", sign === 1 ? "ascending" : "descending");
        const key = (row) => row.children[column].dataset.key;
        const compare = (a, b) => {
            if (a === "" || b === "") {
                return (a === "") - (b === "");
            }
            const difference = Number(a) - Number(b);
            return sign * (isNaN(difference) ? a.localeCompare(b, "en", { numeric: true }) : difference);
        };
        body.append(...[...body.rows].sort((a, b) => compare(key(a), key(b))));
    });
}

// Pictures that are compared lie on each other, parted by a line that a pointer or the arrow keys move.
const element = (name, properties = {}, ...children) => {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
};
for (const compared of document.querySelectorAll(".compare")) {
    const figures = [...compared.querySelectorAll("figure")];
    const images = figures.map((figure) => figure.querySelector("img"));
    const names = figures.map((figure, i) => figure.querySelector("figcaption")?.textContent ?? images[i].alt);
    const stack = element("div", { className: "stack" });
    const range = element("input", { type: "range", min: 0, max: 100, step: 0.5, value: 50 });
    range.setAttribute("aria-label", "How much of the left picture is shown, in percent");
    const move = () => stack.style.setProperty("--split", `${range.value}%`);
    const sides = [compared.dataset.first, compared.dataset.second].map((chosen, side) => {
        const image = element("img", { draggable: false });
        const select = element("select", {}, ...names.map((name, i) => new Option(name, i)));
        select.value = chosen;
        const show = () => {
            const source = images[select.value];
            image.src = source.src;
            image.alt = source.alt;
            image.width = source.getAttribute("width");
            image.height = source.getAttribute("height");
        };
        select.addEventListener("change", show);
        show();
        stack.append(image);
        return element("label", {}, side ? "Right" : "Left", select);
    });
    const drag = (event) => {
        const box = stack.getBoundingClientRect();
        range.value = 100 * (event.clientX - box.left) / box.width;
        move();
    };
    stack.addEventListener("pointerdown", (event) => {
        stack.setPointerCapture(event.pointerId);
        drag(event);
    });
    stack.addEventListener("pointermove", (event) => {
        if (event.buttons) {
            drag(event);
        }
    });
    range.addEventListener("input", move);
    move();
    compared.querySelector(".grid").replaceWith(
        element("div", { className: "slider" }, element("div", { className: "choices" }, ...sides), stack, range));
}
